"""Connections of callers that do not finish their sentence."""

import json
import socket
import threading
import time

import pytest
import uvicorn
from starlette.requests import Request
from starlette.responses import PlainTextResponse

from service.patience import patient

PATIENCE = 0.5


async def app(scope, receive, send):
    """Answers with the length of the body."""
    body = await Request(scope, receive).body()
    await PlainTextResponse(str(len(body)))(scope, receive, send)


@pytest.fixture(scope="module")
def port():
    listener = socket.create_server(("127.0.0.1", 0))
    config = uvicorn.Config(
        app, http=patient(PATIENCE), lifespan="off", log_config=None, timeout_keep_alive=60
    )
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, args=([listener],))
    thread.start()
    yield listener.getsockname()[1]
    server.should_exit = True
    thread.join()


@pytest.fixture
def caller(port):
    with socket.create_connection(("127.0.0.1", port), timeout=10) as caller:
        yield caller


def heard(caller):
    """Everything until the service hangs up."""
    content = b""
    while piece := caller.recv(65536):
        content += piece
    return content


def answered(caller):
    """A whole answer whose body is one byte, which may come by itself."""
    content = b""
    while not content.partition(b"\r\n\r\n")[2]:
        content += caller.recv(65536)
    return content


HALF_HEAD = b"GET / HTTP/1.1\r\nHost: x\r\nX-Sl"
HEAD_OF_BODY = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 10\r\n\r\n"


@pytest.mark.parametrize("sent", [b"", b"G", HALF_HEAD, HEAD_OF_BODY, HEAD_OF_BODY + b"12345"])
def test_a_request_that_does_not_come_to_its_end_is_refused(caller, sent):
    began = time.monotonic()
    caller.sendall(sent)
    head, _, body = heard(caller).partition(b"\r\n\r\n")

    assert PATIENCE - 0.05 <= time.monotonic() - began < PATIENCE + 5
    assert head.startswith(b"HTTP/1.1 408 ")
    assert b"content-type: application/problem+json" in head
    assert json.loads(body)["code"] == "request_timeout"


def test_a_drip_is_no_request(caller):
    """A byte now and then does not buy more time than it is worth."""
    began = time.monotonic()
    caller.sendall(HEAD_OF_BODY)
    caller.settimeout(0.1)
    content = b""
    while time.monotonic() - began < 5:
        try:
            content = caller.recv(65536)
            break
        except TimeoutError:
            caller.sendall(b"1")

    assert content.startswith(b"HTTP/1.1 408 ")
    assert time.monotonic() - began < PATIENCE + 2


def test_a_slow_line_that_keeps_coming_is_heard_out(caller):
    """16 KiB at 8 KiB a second take four times the patience."""
    size = 16384
    caller.sendall(HEAD_OF_BODY.replace(b"10", str(size).encode()))
    for _ in range(16):
        time.sleep(PATIENCE / 4)
        caller.sendall(b"x" * (size // 16))

    answer = b""
    while not answer.endswith(str(size).encode()):
        piece = caller.recv(65536)
        assert piece, answer
        answer += piece


def test_a_connection_may_rest_between_requests(caller):
    for _ in range(2):
        caller.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n")
        assert answered(caller).startswith(b"HTTP/1.1 200 ")
        time.sleep(2 * PATIENCE)


def test_a_second_request_has_to_come_to_its_end_too(caller):
    caller.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n")
    assert answered(caller).startswith(b"HTTP/1.1 200 ")
    caller.sendall(HALF_HEAD)

    assert heard(caller).startswith(b"HTTP/1.1 408 ")
