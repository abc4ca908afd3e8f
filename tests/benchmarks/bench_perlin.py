"""Gradient noise 2048², medians of runs that take turns, compilation excluded.

One octave has 64 cells of 32 px per tile; six octaves go from 256 px to 8 px per cell. Write
bandwidth is a fresh array of the same 16 MiB filled by as many threads. Reach: 20 times the peer.
"""

from collections.abc import Callable
from statistics import median
from time import perf_counter
from typing import Any

import numba
import numpy as np

from api_schemas.textures.perlin import PerlinSpec
from tests.benchmarks.noise_peers import fastnoiselite, pictures
from worker.numba_kernel import parallel_kernel, prange
from worker.stages import silent
from worker.synthesis.perlin import synthesize

SIZE = 2048
REPEATS = 21
ONE_OCTAVE = PerlinSpec(technique="perlin", frequency=64)
SIX_OCTAVES = PerlinSpec(technique="perlin", frequency=8, octaves=6)


def measure() -> list[dict[str, Any]]:
    """Measure ours with one thread and with all, the peers with their one, and the memory."""
    peers = pictures(SIZE, ONE_OCTAVE.frequency)
    coordinates = np.stack(np.meshgrid(*[np.arange(SIZE, dtype=np.float32)] * 2)).reshape(2, -1)
    all_threads = numba.config.NUMBA_NUM_THREADS
    works: dict[str, Callable[[], object]] = {
        "peer": peers.pop("pyfastnoiselite"),
        "one octave, 1": lambda: with_threads(1, lambda: picture(ONE_OCTAVE)),
        "one octave, all": lambda: with_threads(all_threads, lambda: picture(ONE_OCTAVE)),
        "six octaves, 1": lambda: with_threads(1, lambda: picture(SIX_OCTAVES)),
        "six octaves, all": lambda: with_threads(all_threads, lambda: picture(SIX_OCTAVES)),
        "memory, 1": lambda: with_threads(1, fresh_memory),
        "memory, all": lambda: with_threads(all_threads, fresh_memory),
    }
    times = medians(works)
    rugged = fastnoiselite(1 / 256, octaves=6)
    slow = medians(peers | {"six octaves": lambda: rugged.gen_from_coords(coordinates)}, repeats=2)
    six_octaves_peer = slow.pop("six octaves")

    ours = times["one octave, all"]
    rows = [
        row(f"one octave, {name}", seconds, f"ours {seconds / ours:.0f}x")
        for name, seconds in slow.items()
    ]
    for octaves, theirs in (("one octave", times["peer"]), ("six octaves", six_octaves_peer)):
        rows.append(row(f"{octaves}, pyfastnoiselite", theirs, ""))
        for threads, name in ((1, "1"), (all_threads, "all")):
            ours = times[f"{octaves}, {name}"]
            share = times[f"memory, {name}"] / ours
            note = f"{theirs / ours:.1f}x the peer, {share:.0%} of write bandwidth"
            rows.append(row(f"{octaves}, tileable, {threads} thread(s)", ours, note))
    return rows


def row(work: str, seconds: float, note: str) -> dict[str, Any]:
    """One row of the table: milliseconds, with the pixel rate in front of the note."""
    rate = f"{SIZE * SIZE / seconds / 1e6:.0f} Mpix/s"
    return {
        "work": f"Perlin {SIZE}², {work}",
        "figure": round(seconds * 1000, 2),
        "unit": "ms",
        "note": f"{rate}, {note}" if note else rate,
    }


def medians(works: dict[str, Callable[[], object]], repeats: int = REPEATS) -> dict[str, float]:
    """Return seconds by name; every work runs once before it counts."""
    times: dict[str, list[float]] = {name: [] for name in works}
    for turn in range(repeats + 1):
        for name, work in works.items():
            begin = perf_counter()
            work()
            if turn:
                times[name].append(perf_counter() - begin)
    return {name: median(seconds) for name, seconds in times.items()}


def with_threads(threads: int, work: Callable[[], object]) -> None:
    """Run with a number of numba's threads."""
    numba.set_num_threads(threads)
    work()


def picture(spec: PerlinSpec) -> object:
    """One tile."""
    return synthesize(spec, (SIZE, SIZE), {}, silent)


def fresh_memory() -> None:
    """Fill new memory as large as a picture."""
    fill(np.empty((SIZE, SIZE), np.float32))


@parallel_kernel
def fill(pixels: np.ndarray) -> None:
    """Write every pixel once."""
    for row in prange(len(pixels)):
        pixels[row] = 1.0
