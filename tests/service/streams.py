"""Callers that read a stream as they please: at once, slowly, or not to the end."""

import asyncio
import json
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Event:
    """One server-sent event."""

    kind: str
    name: str
    job: dict[str, Any]


def events(text: str) -> list[Event]:
    """Read a stream as the HTML standard says: blocks of lines, ended by an empty one."""
    found = []
    for block in text.split("\n\n")[:-1]:
        fields = dict(
            line.split(": ", 1) for line in block.split("\n") if line and not line.startswith(":")
        )
        if "data" in fields:
            found.append(Event(fields["event"], fields["id"], json.loads(fields["data"])))
    return found


@dataclass
class Caller:
    """One caller of an app, without a network between them."""

    app: Any
    path: str
    headers: dict[str, str] = field(default_factory=dict)
    status: int = 0
    text: str = ""
    reading: asyncio.Event = field(default_factory=asyncio.Event)
    gone: asyncio.Event = field(default_factory=asyncio.Event)
    arrived: asyncio.Event = field(default_factory=asyncio.Event)

    def __post_init__(self) -> None:
        self.reading.set()

    async def call(self) -> "Caller":
        """Read to the end of the stream."""
        scope = {
            "type": "http",
            "asgi": {"version": "3.0", "spec_version": "2.3"},
            "http_version": "1.1",
            "method": "GET",
            "scheme": "http",
            "path": self.path,
            "raw_path": self.path.encode(),
            "query_string": b"",
            "root_path": "",
            "headers": [(k.lower().encode(), v.encode()) for k, v in self.headers.items()],
            "client": ("test", 1),
            "server": ("test", 80),
            "app": self.app,
        }
        await self.app(scope, self._receive, self._send)
        return self

    @property
    def events(self) -> list[Event]:
        return events(self.text)

    async def heard(self, count: int) -> "Caller":
        """Wait until so many events have come."""
        return await self.until(lambda: len(self.events) >= count)

    async def until(self, is_so: Callable[[], bool]) -> "Caller":
        """Wait until what has come makes something true."""
        async with asyncio.timeout(20):
            while not is_so():
                self.arrived.clear()
                await self.arrived.wait()
        return self

    async def _receive(self) -> dict[str, Any]:
        await self.gone.wait()
        return {"type": "http.disconnect"}

    async def _send(self, message: dict[str, Any]) -> None:
        await self.reading.wait()
        if message["type"] == "http.response.start":
            self.status = message["status"]
        self.text += message.get("body", b"").decode()
        self.arrived.set()
