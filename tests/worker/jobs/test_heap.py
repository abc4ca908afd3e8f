"""Memory that nobody uses goes back to the system."""

import subprocess
import sys

from worker.jobs.heap import GROWTH_BYTES

HOLES = """
from worker.jobs.heap import Heap, resident_bytes

heap = Heap()
before = resident_bytes()
blocks = [bytes(2000) for _ in range(100_000)]
kept = blocks[::100]  # two in a hundred pages stay in use, also at the very end
grown = resident_bytes() - before
del blocks
left = resident_bytes() - before
heap.tidy()
print(grown, left, resident_bytes() - before)
"""


def run(script):
    return subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    ).stdout


def test_holes_in_the_heap_are_returned():
    grown, left, tidied = map(int, run(HOLES).split())

    assert grown > 190e6
    assert left > 0.9 * grown, "the C library returned them by itself: nothing to tidy"
    # A block that is kept lies on one or two pages of two blocks each
    assert tidied < 0.1 * grown


def test_a_heap_that_did_not_grow_is_left_alone():
    holes = HOLES.replace("range(100_000)", f"range({GROWTH_BYTES // 2000 * 9 // 10})")
    _, left, tidied = map(int, run(holes).split())

    assert tidied > 0.95 * left
