import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from service import server

ROOT = Path(__file__).parents[2]


def serve(data):
    """Start a service that should not stay."""
    return subprocess.run(
        [sys.executable, "-m", "service"],
        cwd=ROOT,
        env=os.environ | {"TEXLOOM_DATA": str(data), "TEXLOOM_PORT": "0", "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_damaged_records_are_told_in_one_line_and_left_alone(tmp_path):
    content = b"no database " * 999
    (tmp_path / "jobs.sqlite").write_bytes(content)

    ended = serve(tmp_path)

    assert ended.returncode == 1
    assert ended.stderr.startswith("texloom: cannot use")
    assert "file is not a database" in ended.stderr
    assert ended.stderr.count("\n") == 1
    assert (tmp_path / "jobs.sqlite").read_bytes() == content


@pytest.mark.parametrize("place", ["file", "file/below"])
def test_a_data_folder_that_cannot_be_is_told_in_one_line(tmp_path, place):
    (tmp_path / "file").touch()

    ended = serve(tmp_path / place)

    assert ended.returncode == 1
    assert ended.stderr.startswith("texloom: cannot use the data folder")
    assert ended.stderr.count("\n") == 1


def test_a_caller_that_reads_nothing_is_given_up(monkeypatch):
    """The kernel ends a connection whose buffers stay full; what is written then fails."""
    monkeypatch.setattr(server, "UNREAD_SECONDS", 1)
    with server.listening("127.0.0.1", 0) as listener:
        listener.listen()
        with socket.create_connection(listener.getsockname()):
            accepted, _ = listener.accept()
            with accepted, pytest.raises(TimeoutError):
                write_for(accepted, 20)


def write_for(connection, seconds):
    deadline = time.monotonic() + seconds
    connection.setblocking(False)
    while time.monotonic() < deadline:
        try:
            connection.send(bytes(1 << 16))
        except BlockingIOError:
            time.sleep(0.05)
