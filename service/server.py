"""The web server: bound to an address, and draining when it is told to stop."""

import socket
import sys
import threading
from types import FrameType
from typing import Final

import uvicorn
from fastapi import FastAPI

from service.app import create_app, make_engine
from service.patience import patient
from service.settings import Settings
from worker.jobs.errors import JobsError

UNREAD_SECONDS: Final = 60
"""After which the kernel gives up a caller that takes nothing of what was sent to it."""


class Server(uvicorn.Server):
    """Goes on answering while the engine drains: the first signal drains, the second one ends."""

    def __init__(self, config: uvicorn.Config, app: FastAPI) -> None:
        super().__init__(config)
        self._state = app.state
        self._drain: threading.Thread | None = None

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """Take nothing new, finish what is running, then stop serving."""
        if self._drain is not None:
            super().handle_exit(sig, frame)
            return

        def drain() -> None:
            self._state.engine.drain(self._state.settings.drain_seconds)
            self._state.drained.set()
            self.should_exit = True

        self._drain = threading.Thread(target=drain, name="drain")
        self._drain.start()


def serve(settings: Settings) -> int:
    """Serve until told to stop; the answer is the exit code."""
    try:
        engine = make_engine(settings)
    except OSError as error:
        return _refused(f"cannot use the data folder {settings.data}: {error.strerror}")
    app = create_app(settings, engine)
    config = uvicorn.Config(
        app,
        host=settings.host,
        port=settings.port,
        log_level=settings.log_level,
        log_config=None,
        access_log=False,
        http=patient(settings.patience_seconds),
        server_header=False,
        timeout_graceful_shutdown=5,
    )
    server = Server(config, app)
    try:
        listener = listening(settings.host, settings.port)
        engine.start()
    except (OSError, JobsError) as error:
        return _refused(str(error))
    print(f"Texloom serves {address(listener)} (documentation: /docs)", flush=True)  # noqa: T201
    server.run([listener])
    return 0


def _refused(why: str) -> int:
    print(f"texloom: {why}", file=sys.stderr)  # noqa: T201
    return 1


def listening(host: str, port: int) -> socket.socket:
    """Return a socket bound to an address; port 0 takes a free one.

    It says that it is TCP: only then asyncio switches off Nagle's algorithm, which makes every
    answer on a connection that is kept wait 40 ms for the caller's delayed acknowledgement.
    The connections it accepts inherit its patience with callers that do not read.

    Raises:
        OSError: The address is in use or not of this machine.
    """
    found = socket.getaddrinfo(
        host, port, type=socket.SOCK_STREAM, proto=socket.IPPROTO_TCP, flags=socket.AI_PASSIVE
    )
    family, kind, protocol, _, place = found[0]
    listener = socket.socket(family, kind, protocol)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, UNREAD_SECONDS * 1000)
    try:
        listener.bind(place)
    except OSError as error:
        listener.close()
        raise OSError(f"cannot listen on {host} port {port}: {error.strerror}") from error
    return listener


def address(listener: socket.socket) -> str:
    """Return the URL of a bound socket."""
    host, port = listener.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
