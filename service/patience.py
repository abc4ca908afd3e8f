"""Ends connections whose requests come too slowly: they would be held open for ever otherwise."""

import asyncio
from typing import Any, Final

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from service.problems import ProblemError

LEAST_BYTES_PER_SECOND: Final = 1024
"""Of a body, after a pause that is allowed once; a modem of 1995 was faster."""


class PatientProtocol(H11Protocol):
    """Uvicorn's own, with a limit to the time between the first byte of a request and its last.

    The head has to arrive within `patience_seconds`. So has the body, but every KiB of it buys
    another second.
    """

    patience_seconds = 30.0

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._timer: asyncio.TimerHandle | None = None
        self._deadline = 0.0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for a head."""
        super().connection_made(transport)
        self._begin()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing any more."""
        self._end()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Go on waiting while a request is incomplete."""
        was_in_body = self._is_in_body()
        super().data_received(data)
        if self._is_in_body():
            if not was_in_body:
                self._begin()
            self._deadline += len(data) / LEAST_BYTES_PER_SECOND
        elif self.conn.their_state is h11.IDLE and self.conn.trailing_data[0]:
            if self._timer is None:
                self._begin()
        else:
            self._end()

    def _is_in_body(self) -> bool:
        return self.conn.their_state is h11.SEND_BODY

    def _begin(self) -> None:
        self._end()
        self._deadline = self.loop.time() + self.patience_seconds
        self._timer = self.loop.call_at(self._deadline, self._look)

    def _end(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _look(self) -> None:
        """See whether the time is up."""
        self._timer = None
        if self.transport.is_closing():
            return
        if self.flow.read_paused:  # it is us who do not read
            self._deadline = self.loop.time() + self.patience_seconds
        if self.loop.time() < self._deadline:
            self._timer = self.loop.call_at(self._deadline, self._look)
            return
        is_answering = (
            self.cycle is not None
            and self.cycle.response_started
            and not self.cycle.response_complete
        )
        if not is_answering:
            self.transport.write(_refusal())
        self.transport.close()


def patient(seconds: float) -> type[PatientProtocol]:
    """Return the protocol with a patience of its own."""
    return type("Patient", (PatientProtocol,), {"patience_seconds": seconds})


def _refusal() -> bytes:
    """Return the answer as it goes over the wire: there is no request that the app could answer."""
    answer = ProblemError("request_timeout", headers={"Connection": "close"}).response()
    head = [b"HTTP/1.1 408 Request Timeout"]
    head += [name + b": " + value for name, value in answer.raw_headers]
    return b"\r\n".join([*head, b"", bytes(answer.body)])
