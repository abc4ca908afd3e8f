"""Server-sent events: how one job is, until it is finished.

Whoever reads slowly gets the latest news and never a backlog, and whoever hangs up is forgotten at
once.
"""

from typing import Final

import anyio
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from service.job_views import view
from worker.jobs.job import FINAL_STATES, Job
from worker.jobs.queue import JobQueue
from worker.jobs.watch import Follower, news_id

MEDIA_TYPE: Final = "text/event-stream"
HEARTBEAT_SECONDS: Final = 15.0
"""Between signs of life: below the minute after which proxies give a silent connection up."""

RECONNECT: Final = b"retry: 1000\n\n"
"""The first thing sent: a sign that the stream is open, and how long to wait when it breaks."""


class EventStream(Response):
    """Tells the news of a job that the caller does not know yet, and ends after its end."""

    def __init__(self, engine: JobQueue, job: Job, last_event_id: str | None) -> None:
        super().__init__(media_type=MEDIA_TYPE)
        self._engine = engine
        self._job = job
        self._known = last_event_id
        del self.headers["content-length"]
        self.headers["Cache-Control"] = "no-store"
        self.headers["X-Accel-Buffering"] = "no"  # or a proxy would keep the news to itself

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Stream until the job is finished, the service stops, or nobody listens any more."""
        await send(
            {"type": "http.response.start", "status": 200, "headers": self.raw_headers},
        )

        async def say(text: bytes, *, more: bool = True) -> None:
            await send({"type": "http.response.body", "body": text, "more_body": more})

        with self._engine.watch.following(self._job) as follower:
            async with anyio.create_task_group() as group:
                group.start_soon(_until_gone, receive, group.cancel_scope)
                await say(RECONNECT)
                while True:
                    is_over = follower.is_over  # asked first: more may come while this is sent
                    if news := self._news(follower):
                        await say(news)
                    if is_over:
                        break
                    if not await follower.changed(HEARTBEAT_SECONDS):
                        await say(b": still here\n\n")
                await say(b"", more=False)
                group.cancel_scope.cancel()

    def _news(self, follower: Follower) -> bytes:
        """Return an event, or nothing where the caller knows it."""
        job = follower.job
        name = news_id(job)
        if name == self._known:
            return b""
        self._known = name
        kind = "end" if job.state in FINAL_STATES else "progress"
        told = view(job, self._engine.forecast.seconds_left(job)).model_dump_json()
        return f"event: {kind}\nid: {name}\ndata: {told}\n\n".encode()


async def _until_gone(receive: Receive, streaming: anyio.CancelScope) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass
    streaming.cancel()
