"""Keeps a service busy with mixed work, and watches its memory and its open files.

`make soak` takes twenty minutes; `python -m tests.soak --minutes 2` fewer. It prints the table that
is kept in tests/benchmarks/RESULTS.md, and fails when an answer was wrong or something grew.
"""

import argparse
import statistics
import sys
import tempfile
import time
from dataclasses import astuple, dataclass
from pathlib import Path

from tests.running_service import RunningService
from tests.soak.work import Work, callers
from worker.jobs.heap import resident_bytes

CALLERS = 3
LOOKS = 40
GROWTH_MAX = 0.05
FILES_MAX = 8


@dataclass(frozen=True, slots=True)
class Look:
    """How the service is after a while."""

    minutes: float
    answers: int
    service_mb: float
    children_mb: float
    open_files: int


def main() -> int:
    """Soak; the answer is the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=20)
    minutes = parser.parse_args().minutes
    with tempfile.TemporaryDirectory(prefix="texloom-soak-") as folder:
        service = RunningService(Path(folder) / "data").start()
        work = Work(service.url)
        threads = list(callers(work, CALLERS))
        looks = []
        start = time.monotonic()
        for number in range(1, LOOKS + 1):
            time.sleep(max(0.0, start + 60 * minutes * number / LOOKS - time.monotonic()))
            looks.append(look(service, work, (time.monotonic() - start) / 60))
            print(*(round(value, 1) for value in astuple(looks[-1])), file=sys.stderr, flush=True)
        work.stopping.set()
        for thread in threads:
            thread.join()
        service.stop()
    print(table(looks))
    complaints = [*work.faults, *grown(looks)]
    print("\n".join(complaints) or "nothing grew, and every answer was right")
    return 1 if complaints else 0


def look(service: RunningService, work: Work, minutes: float) -> Look:
    """Add up what the service and its children hold."""
    assert service.process is not None
    parent = service.process.pid
    held = {pid: resident_bytes(pid) / 1e6 for pid in service.processes()}
    files = sum(len(list(Path(f"/proc/{pid}/fd").iterdir())) for pid in held)
    own = held.pop(parent)
    return Look(minutes, work.done, own, sum(held.values()), files)


def grown(looks: list[Look]) -> list[str]:
    """Compare the last quarter with the second one, when all caches are full."""
    quarter = len(looks) // 4
    early, late = looks[quarter : 2 * quarter], looks[-quarter:]
    complaints = []
    for name in ("service_mb", "children_mb"):
        before, after = (
            statistics.mean(getattr(item, name) for item in part) for part in (early, late)
        )
        if after > before * (1 + GROWTH_MAX):
            complaints.append(f"{name} grew from {before:.0f} to {after:.0f}")
    before, after = (min(item.open_files for item in part) for part in (early, late))
    if after > before + FILES_MAX:
        complaints.append(f"open files grew from {before} to {after}")
    return complaints


def table(looks: list[Look]) -> str:
    """Draw every fourth look as a row of Markdown."""
    lines = ["| minutes | answers | service MB | children MB | open files |", "| --- " * 5 + "|"]
    lines += [
        f"| {item.minutes:.1f} | {item.answers} | {item.service_mb:.0f} "
        f"| {item.children_mb:.0f} | {item.open_files} |"
        for item in looks[3::4]
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
