"""Reactions, cells and steps a second, compilation excluded.

Gray and Scott's chemicals in float32, eight steps in one pass over the dish by all threads, beside
one step a pass, and beside numpy, which rolls whole arrays. The others are float64 by one thread.
Writing alone: how often a second as many bytes as a step's new cells take can be written to memory.
"""

from collections.abc import Callable
from time import perf_counter
from typing import Any

import numba
import numpy as np

from api_schemas.textures.gray_scott import GrayScottSpec
from api_schemas.textures.schnakenberg import SchnakenbergSpec
from api_schemas.textures.turing import TuringSpec
from tests.benchmarks.bench_perlin import fill
from worker.stages import silent
from worker.synthesis import gray_scott, schnakenberg, turing
from worker.synthesis._gray_scott_steps import STEPS_AT_ONCE, advance

REPEATS = 5


def measure() -> list[dict[str, Any]]:
    """Measure dishes that fit into the cache and one that does not."""
    rows = []
    for side, steps in ((256, 1600), (1024, 160), (2048, 80)):
        spec = GrayScottSpec(technique="gray_scott", size=[side, side], steps=steps)
        u, v = gray_scott.initial_dish(spec)
        rates = gray_scott.rates_of(spec, {})
        threads = numba.get_num_threads()
        work = f"Gray-Scott {side}², "
        reach = ", reach: 1800" if side == 2048 else ""
        seconds = best(lambda spec=spec, u=u, v=v, r=rates: gray_scott.run(spec, u, v, r))
        writing = best(lambda side=side: fill(np.empty((2 * side, side), np.float32)))
        rows.append(
            row(
                f"{work}{STEPS_AT_ONCE} steps a pass, {threads} thread(s){reach}",
                side,
                steps,
                seconds,
                f", {writing * steps / seconds:.0%} of writing alone",
            )
        )
        cells = np.pad(np.stack([u, v], axis=1), ((1, 1), (0, 0), (1, 1)), mode="wrap")
        after = cells.copy()
        seconds = best(lambda a=after, c=cells, r=rates: advance(a, c, r, 1, 0))
        rows.append(row(f"{work}1 step a pass, {threads} thread(s)", side, 1, seconds))
        rows.append(row(f"{work}numpy", side, 1, best(lambda u=u, v=v: rolled(u, v))))
    for name, module, spec in (
        ("Turing", turing, TuringSpec(technique="turing", size=[256, 256], steps=400)),
        ("Schnakenberg", schnakenberg, SchnakenbergSpec(technique="schnakenberg", steps=400)),
    ):
        seconds = best(lambda m=module, s=spec: m.synthesize(s, (256, 256), {}, silent))
        rows.append(row(f"{name} 256², float64, 1 thread", 256, 400, seconds))
    return rows


def rolled(u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """One explicit step as it is usually written."""
    around = [sum(np.roll(c, s, a) for s in (1, -1) for a in (0, 1)) - 4 * c for c in (u, v)]
    met = u * v * v
    return (
        u + np.float32(0.2) * around[0] - met + np.float32(0.037) * (1 - u),
        v + np.float32(0.1) * around[1] + met - np.float32(0.097) * v,
    )


def best(work: Callable[[], object]) -> float:
    """Return the seconds of the quickest of some runs after one that does not count."""
    times = []
    for _ in range(REPEATS + 1):
        begin = perf_counter()
        work()
        times.append(perf_counter() - begin)
    return min(times[1:])


def row(work: str, side: int, steps: int, seconds: float, note: str = "") -> dict[str, Any]:
    """One row of the table: millions of cells and steps a second."""
    return {
        "work": work,
        "figure": round(side * side * steps / seconds / 1e6),
        "unit": "Mcell/s",
        "note": f"{1000 * seconds / steps:.3f} ms a step{note}",
    }
