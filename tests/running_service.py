"""A real service in its own process, on a free port and an empty data folder."""

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import httpx

ROOT = Path(__file__).resolve().parent.parent
WARM = ROOT / ".cache" / "cache"
SECONDS_TO_START = 300


@dataclass
class RunningService:
    """A service process, its address and its data folder."""

    data: Path
    settings: dict[str, str] = field(default_factory=dict)
    folder: Path = ROOT
    process: subprocess.Popen[bytes] | None = None
    url: str = ""

    def start(self) -> "RunningService":
        """Start the service, with what this clone has compiled, and wait until it is warm."""
        self.copy_caches()
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.url = f"http://127.0.0.1:{port}"
        with (self.data.parent / "service.log").open("ab") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "service"],
                cwd=self.folder,
                env={**os.environ, "TEXLOOM_PORT": str(port), "TEXLOOM_DATA": str(self.data)}
                | {"PYTHONPATH": str(self.folder), **self.settings},
                stdout=log,
                stderr=log,
            )
        return self.wait_until_warm()

    def copy_caches(self) -> None:
        """Take over what this clone has compiled."""
        if WARM.is_dir() and not (self.data / "cache").exists():
            shutil.copytree(WARM, self.data / "cache")

    def wait_until_warm(self) -> "RunningService":
        """Wait for a warm worker; one whose job was cancelled has to warm up anew."""
        assert self.process is not None
        deadline = time.monotonic() + SECONDS_TO_START
        while time.monotonic() < deadline:
            assert self.process.poll() is None, self.log()
            try:
                if httpx.get(f"{self.url}/readyz").status_code == 200:
                    return self
            except httpx.TransportError:
                pass
            time.sleep(0.05)
        self.kill()
        raise AssertionError(f"not ready after {SECONDS_TO_START} s:\n{self.log()}")

    def client(self) -> httpx.Client:
        """Return a client of this service."""
        return httpx.Client(base_url=self.url, timeout=120)

    def log(self) -> str:
        """Return what the service wrote."""
        return (self.data.parent / "service.log").read_text()

    def processes(self) -> set[int]:
        """Return every living process that works on this data folder, the service included."""
        mark = f"TEXLOOM_DATA={self.data}".encode()
        found = set()
        for entry in Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and mark in (entry / "environ").read_bytes().split(b"\0"):
                    state = (entry / "stat").read_text().rpartition(")")[2].split()[0]
                    found |= {int(entry.name)} if state != "Z" else set()
            except OSError:
                continue
        return found

    def kill(self) -> None:
        """End the service as a power cut would."""
        assert self.process is not None
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def stop(self) -> int:
        """Ask the service to end and return its exit code."""
        assert self.process is not None
        if self.process.poll() is None:
            self.process.terminate()
        return self.process.wait(60)
