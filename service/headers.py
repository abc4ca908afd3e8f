"""Headers for every answer, and the refusal of writes that pages from elsewhere send."""

from collections.abc import Collection
from typing import Final
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from service.problems import ProblemError

READING: Final = ("GET", "HEAD", "OPTIONS")
STRICT: Final = "default-src 'none'; frame-ancestors 'none'"
PAGES: Final = (
    "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; connect-src 'self'; worker-src 'self' blob:; font-src 'self'; "
    "frame-ancestors 'none'"
)
"""The pages of the documentation start their script inline."""


class SecurityHeaders:
    """Adds what browsers need to know to every response that does not say it itself."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on and decorate its answer."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def decorated(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                page = headers.get("content-type", "").startswith("text/html")
                headers.setdefault("X-Content-Type-Options", "nosniff")
                headers.setdefault("Referrer-Policy", "no-referrer")
                headers.setdefault("Content-Security-Policy", PAGES if page else STRICT)
            await send(message)

        await self._app(scope, receive, decorated)


class SameOriginWrites:
    """Refuses writes that a browser sends for a page of an origin nobody has allowed.

    A page anywhere may post a form to this machine; its browser says so in the Origin header.
    """

    def __init__(self, app: ASGIApp, allowed: Collection[str]) -> None:
        self._app = app
        self._allowed = allowed

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] == "http" and scope["method"] not in READING:
            headers = Headers(scope=scope)
            origin = headers.get("origin")
            if origin is not None and not self._is_trusted(origin, headers.get("host", "")):
                await ProblemError("origin_refused").response()(scope, receive, send)
                return
        await self._app(scope, receive, send)

    def _is_trusted(self, origin: str, host: str) -> bool:
        if origin in self._allowed or "*" in self._allowed:
            return True
        try:
            return urlsplit(origin).netloc == host
        except ValueError:  # no URL at all
            return False
