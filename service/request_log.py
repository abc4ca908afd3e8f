"""Names every request, writes one line about it, and counts it."""

import logging
import re
import time
import uuid
from typing import Final

from prometheus_client import CollectorRegistry, Counter, Histogram
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from worker.jobs.log_lines import telling

REQUEST_ID: Final = "X-Request-Id"
ACCEPTABLE: Final = re.compile(r"[A-Za-z0-9._-]{1,64}")
METHODS: Final = frozenset({"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"})
SECONDS: Final = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60)

log = logging.getLogger(__name__)


class RequestMeters:
    """How many requests there were, of what kind, and how long their answers took to begin."""

    def __init__(self) -> None:
        self.registry = CollectorRegistry()
        self._count = Counter(
            "texloom_http_requests",
            "Requests answered.",
            ("method", "route", "status"),
            registry=self.registry,
        )
        self._seconds = Histogram(
            "texloom_http_seconds",
            "Until the answer began; callers may have asked to wait.",
            ("method", "route"),
            buckets=SECONDS,
            registry=self.registry,
        )

    def answered(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count one answer."""
        self._count.labels(method, route, str(status)).inc()
        self._seconds.labels(method, route).observe(seconds)


class RequestLog:
    """Wraps the app: each request gets an id, which its answer and its lines in the log carry.

    A caller may choose the id, as long as it is short and plain.
    """

    def __init__(self, app: ASGIApp, meters: RequestMeters) -> None:
        self._app = app
        self._meters = meters

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, and tell about it when its answer has gone out."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        wished = Headers(scope=scope).get(REQUEST_ID, "")
        request_id = wished if ACCEPTABLE.fullmatch(wished) else uuid.uuid4().hex
        began = time.perf_counter()
        status, answer_began = 0, began

        async def noted(message: Message) -> None:
            nonlocal status, answer_began
            if message["type"] == "http.response.start":
                status, answer_began = message["status"], time.perf_counter()
                MutableHeaders(scope=message)[REQUEST_ID] = request_id
            await send(message)

        with telling(request=request_id):
            try:
                await self._app(scope, receive, noted)
            finally:
                self._tell(scope, status, answer_began - began, time.perf_counter() - began)

    def _tell(self, scope: Scope, status: int, to_begin: float, to_end: float) -> None:
        method = scope["method"] if scope["method"] in METHODS else "other"
        # Of what was asked for only the route is a label: there are few of them.
        route = getattr(scope.get("route"), "path", "none")
        self._meters.answered(method, route, status, to_begin)
        fields = {
            "method": scope["method"],
            "path": scope["path"],
            "status": status,
            "ms": round(to_end * 1000, 2),
        }
        log.info("answered", extra={"fields": fields})
