"""Runs mixed jobs while processes are killed and the machine misbehaves, and counts what is lost.

`make faults` runs it with three seeds; `python -m tests.faults --seeds 7 --jobs 50` with others. It
prints the tables that are kept in tests/benchmarks/RESULTS.md, and fails when anything was lost,
made twice, made differently, or left behind.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from tests.faults.campaign import Campaign, Report
from tests.faults.requests import mixed
from tests.faults.service import FaultyService


def main() -> int:
    """Run every seed; the answer is the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--executor", choices=["mixed", "toy"], default="mixed")
    parser.add_argument("--jobs", type=int, default=200)
    parser.add_argument("--faults", type=int, default=30)
    wished = parser.parse_args()
    reports = []
    for seed in wished.seeds:
        print(f"faults: seed {seed}", file=sys.stderr, flush=True)
        reports.append(run(seed, wished))
        print(reports[-1].table(), flush=True)
    return 1 if any(report.complaints for report in reports) else 0


def run(seed: int, wished: argparse.Namespace) -> Report:
    """Make every picture undisturbed, then all of them again under faults, and compare."""
    requests = mixed(seed, wished.jobs)
    executor = f"tests.faults.{wished.executor}_executor"
    with tempfile.TemporaryDirectory(prefix="texloom-faults-") as folder:
        calm = FaultyService(Path(folder) / "calm" / "data", executor).start()
        expected = calm.make_all(requests)
        calm.stop()
        stormy = FaultyService(Path(folder) / "stormy" / "data", executor).start()
        return Campaign(seed, requests, expected, stormy, wished.faults).run()


if __name__ == "__main__":
    sys.exit(main())
