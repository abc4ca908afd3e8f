"""Streams of a service in its own process: abandoned, broken and taken up again."""

import itertools
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import httpx
import pytest

from tests.service.streams import Event, events

ROOT = Path(__file__).resolve().parents[2]


class ToyServer:
    """A process that serves one data folder, again and again."""

    def __init__(self, data: Path) -> None:
        self.data = data
        self.url = ""

    def start(self) -> "ToyServer":
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.url = f"http://127.0.0.1:{port}"
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.toy_server", str(self.data), str(port)],
            cwd=ROOT,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
        )
        until(self.is_ready)
        return self

    def is_ready(self) -> bool:
        try:
            return httpx.get(f"{self.url}/readyz").status_code == 200
        except httpx.TransportError:
            return False

    def submit(self, seed: int, **output: object) -> dict[str, dict[str, str]]:
        body = {
            "texture": {"technique": "perlin", "seed": seed},
            "output": {"size": [16, 16], **output},
        }
        return httpx.post(f"{self.url}/v1/textures", json=body).json()

    def read(self, job: dict[str, dict[str, str]], last: str = "") -> Iterator[Event]:
        """Yield events until the stream ends or breaks."""
        text, told = "", 0
        headers = {"Last-Event-ID": last} if last else {}
        with httpx.stream(
            "GET", self.url + job["links"]["events"], headers=headers, timeout=30
        ) as response:
            for piece in response.iter_text():
                text += piece
                found = events(text)
                yield from found[told:]
                told = len(found)

    def sockets(self) -> int:
        count = 0
        for file in Path(f"/proc/{self.process.pid}/fd").iterdir():
            with suppress(FileNotFoundError):  # closed meanwhile
                count += str(file.readlink()).startswith("socket:")
        return count

    def threads(self) -> int:
        return len(list(Path(f"/proc/{self.process.pid}/task").iterdir()))

    def end(self, how: int) -> int:
        self.process.send_signal(how)
        return self.process.wait(30)


def until(is_so: Callable[[], bool], seconds: float = 30.0) -> None:
    deadline = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < deadline, "it did not happen in time"
        time.sleep(0.02)


@pytest.fixture
def server(tmp_path):
    server = ToyServer(tmp_path / "data").start()
    yield server
    if server.process.poll() is None:
        server.end(signal.SIGKILL)


def test_a_stream_goes_on_after_the_service_was_killed(server):
    job = server.submit(1005)
    stream, heard = server.read(job), []
    while not heard or not heard[-1].job["progress"]:
        heard.append(next(stream))
    server.end(signal.SIGKILL)
    with pytest.raises(httpx.RemoteProtocolError):
        heard.extend(stream)
    server.start()
    rest = list(server.read(job, heard[-1].name))

    assert rest[-1].kind == "end"
    assert rest[-1].job["state"] == "succeeded"
    assert rest[-1].job["attempt"] == 2
    assert {event.name for event in rest}.isdisjoint(event.name for event in heard)
    for _, attempt in itertools.groupby(heard + rest, key=lambda event: event.job["attempt"]):
        shares = [event.job["progress"] for event in attempt]
        assert shares == sorted(shares), "progress starts anew only with a new attempt"


def test_news_that_was_heard_before_the_restart_is_not_told_again(server):
    """A queued job is as it was: nothing is sent until something changes."""
    server.submit(1002)
    waiting = server.submit(1005)
    stream = server.read(waiting)
    [heard] = itertools.islice(stream, 1)
    stream.close()
    server.end(signal.SIGKILL)
    server.start()
    found = httpx.get(server.url + waiting["links"]["self"]).json()
    with httpx.stream(
        "GET",
        server.url + waiting["links"]["events"],
        headers={"Last-Event-ID": heard.name},
        timeout=0.7,
    ) as response:
        pieces: list[str] = []
        with pytest.raises(httpx.ReadTimeout):
            pieces.extend(response.iter_text())

    assert (found["state"], found["position"]) == ("queued", heard.job["position"])
    assert "".join(pieces) == "retry: 1000\n\n"


def test_a_service_that_stops_ends_its_streams(server):
    running, waiting = server.submit(1007), server.submit(1005)
    stream, other = server.read(running), server.read(waiting)
    next(stream)
    next(other)
    server.process.send_signal(signal.SIGTERM)

    assert [event.kind for event in stream][-1] == "end", "what is running is finished"
    assert "end" not in [event.kind for event in other], "what is not goes on later"
    assert server.process.wait(30) == 0


def test_a_thousand_connections_that_hang_up_leave_nothing_open(server):
    job = server.submit(1002)
    host, port = server.url.removeprefix("http://").split(":")
    path = job["links"]["events"]

    def open_and_hang_up(count: int) -> None:
        streams = [socket.create_connection((host, int(port))) for _ in range(count)]
        for stream in streams:
            stream.sendall(f"GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
        for stream in streams:
            assert stream.recv(12) == b"HTTP/1.1 200"
        for stream in streams:
            stream.close()

    sockets = server.sockets()
    for _ in range(10):
        open_and_hang_up(100)

    until(lambda: server.sockets() <= sockets, 10)
    assert server.threads() < 60, "the 40 of the pool and the engine's own"
    assert httpx.get(f"{server.url}/livez").status_code == 200
