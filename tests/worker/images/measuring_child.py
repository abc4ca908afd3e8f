"""A process that measures hostile pictures, so that a crash is only the death of a child."""

import json
import os
import resource
import selectors
import subprocess
import sys
from pathlib import Path
from typing import Any, Self

ROOT = Path(__file__).resolve().parents[3]
SECONDS = 20
ADDRESS_SPACE = 6 * 2**30

PROGRAM = """
import json, sys
from pathlib import Path
from worker import measure_asset
from worker.errors import UnusableAssetError

for line in sys.stdin:
    try:
        answer = {"facts": measure_asset.run({"path": line[:-1]}, Path("unused"), lambda *_: None)}
    except UnusableAssetError as error:
        answer = {"failure": error.as_failure()}
    # ru_maxrss would begin with what the process held that started this one.
    peak = Path("/proc/self/status").read_text().partition("VmHWM:")[2].split()[0]
    answer["peak_bytes"] = int(peak) * 1024
    print(json.dumps(answer), flush=True)
"""


class MeasuringChild:
    """Asks a child what a file is; says so when it died, raised anything else or hung."""

    def __enter__(self) -> Self:
        self._process = self._start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop()

    def measure(self, path: Path) -> dict[str, Any]:
        """Give {"facts"}, {"failure"} or {"death": exit code or "hang"}, and "peak_bytes"."""
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write(f"{path.resolve()}\n")
        process.stdin.flush()
        with selectors.DefaultSelector() as selector:
            selector.register(process.stdout, selectors.EVENT_READ)
            answered = selector.select(SECONDS)
        line = process.stdout.readline() if answered else ""
        if line:
            return dict(json.loads(line))
        self._stop()
        death = process.returncode if answered else "hang"
        self._process = self._start()
        return {"death": death}

    def fresh(self) -> None:
        """Start over, so that the peak of memory is that of the next file."""
        self._stop()
        self._process = self._start()

    def _start(self) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-c", PROGRAM],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            cwd=ROOT,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
            preexec_fn=_limit_memory,
        )

    def _stop(self) -> None:
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.close()
        process.stdout.close()
        try:
            process.wait(timeout=2)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _limit_memory() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))
