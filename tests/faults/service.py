"""A real service in a process of its own, and the ways to harm it."""

import os
import random
import resource
import signal
import socket
import sqlite3
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import httpx

from tests.faults.requests import Asked
from tests.running_service import ROOT, RunningService

FULL_BYTES = 4096
"""No file grows beyond this while the disk is "full": a limit that needs no rights to set."""

UNTIL_READY_SECONDS = 180.0
UNTIL_GONE_SECONDS = 30.0


class FaultyService(RunningService):
    """Starts like any service, on one port for all its lives."""

    def __init__(self, data: Path, executor: str) -> None:
        data.parent.mkdir(parents=True)
        super().__init__(data)
        self.clock = data.parent / "clock"
        self.clock.write_text("0")
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self.url = f"http://127.0.0.1:{self.port}"
        self._executor = executor
        self._log = bytearray()

    def start(self) -> "FaultyService":
        """Start it and wait until it is warm; its log comes through a pipe, which is never full."""
        self.copy_caches()
        self.begin()
        return self.wait_until_ready()

    def begin(self) -> None:
        """Start the process."""
        environment = os.environ | {
            "TEXLOOM_PORT": str(self.port),
            "TEXLOOM_DATA": str(self.data),
            "TEXLOOM_RECYCLE_AFTER_JOBS": "25",
            "TEXLOOM_DRAIN_SECONDS": "5",
            "PYTHONPATH": str(ROOT),
        }
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.faults.faulty_main", str(self.clock), self._executor],
            cwd=ROOT,
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )
        threading.Thread(target=self._drain, args=[self.process], daemon=True).start()

    def wait_until_ready(self) -> "FaultyService":
        """Wait for a warm worker."""
        deadline = time.monotonic() + UNTIL_READY_SECONDS
        while time.monotonic() < deadline:
            assert self.process is not None
            assert self.process.poll() is None, self.log()
            try:
                if httpx.get(f"{self.url}/readyz", timeout=10).status_code == 200:
                    return self
            except httpx.TransportError:
                pass
            time.sleep(0.05)
        raise AssertionError(f"not ready:\n{self.log()}")

    def log(self) -> str:
        """Return what all its lives wrote."""
        return self._log.decode(errors="replace")

    def make_all(self, requests: Sequence[Asked]) -> dict[str, str]:
        """Return the SHA-256 of every picture, made without any fault."""
        found = {}
        with self.client() as client:
            for asked in requests:
                client.post(asked.path, json=asked.body).raise_for_status()
            for asked in requests:
                headers = {"Prefer": "wait=60"}
                job = client.post(asked.path, json=asked.body, headers=headers).json()
                assert job["state"] == "succeeded", job
                found[asked.key] = job["result"]["sha256"]
        return found

    def kill_child(self, choose: random.Random) -> None:
        """Kill one of the processes below the service, whichever: forkserver and tracker too."""
        assert self.process is not None
        below = sorted(self.processes() - {self.process.pid})
        if below:
            _kill(choose.choice(below))

    def kill_and_restart(self) -> float | None:
        """Kill the service and start it again.

        Returns:
            Seconds until none of its processes was left; None if one outlived it. Who was just
            being started finds out on its first steps.
        """
        before = self.processes()
        self.kill()
        began = time.monotonic()
        while orphans := before & self.processes():
            if time.monotonic() - began > UNTIL_GONE_SECONDS:
                break
            time.sleep(0.01)
        gone = None if orphans else time.monotonic() - began
        self.begin()
        self.wait_until_ready()
        return gone

    def fill_disk(self, seconds: float) -> None:
        """Have no file of the service and of its children grow for a while."""
        for limit in (FULL_BYTES, resource.RLIM_INFINITY):
            for pid in self.processes():
                with suppress(ProcessLookupError):
                    resource.prlimit(pid, resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
            if limit == FULL_BYTES:
                time.sleep(seconds)

    def hold_records(self, seconds: float) -> None:
        """Keep everybody else from writing to the records, as a careless backup would."""
        holder = sqlite3.connect(self.data / "jobs.sqlite", timeout=10, isolation_level=None)
        holder.execute("BEGIN IMMEDIATE")
        time.sleep(seconds)
        holder.execute("ROLLBACK")
        holder.close()

    def jump(self, seconds: float) -> None:
        """Set the service's time of day."""
        self.clock.write_text(str(seconds))

    def _drain(self, process: "subprocess.Popen[bytes]") -> None:
        assert process.stderr is not None
        for line in process.stderr:
            self._log += line
        process.stderr.close()


def _kill(pid: int) -> None:
    with suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)
