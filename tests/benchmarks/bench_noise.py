"""Noise in space, waves and cells, medians of runs that take turns, compilation excluded.

Perlin's solid has 8 cells of 32 voxels along each side and goes up to six octaves; the peers are
those of PyPI that can do the same, and numpy as one would write it down. Ours are tileable.
"""

from typing import Any

import numba
import numpy as np
from pyfastnoiselite.pyfastnoiselite import (
    CellularDistanceFunction,
    CellularReturnType,
    FastNoiseLite,
    NoiseType,
)

from api_schemas.textures.gardner import GardnerSpec
from api_schemas.textures.perlin import PerlinSpec
from api_schemas.textures.wavelet import WaveletSpec
from api_schemas.textures.worley import WorleySpec
from tests.benchmarks.bench_perlin import medians, with_threads
from tests.benchmarks.noise_peers import fastnoiselite
from worker.numba_kernel import parallel_kernel, prange
from worker.stages import silent
from worker.synthesis import gardner, perlin, wavelet, worley

SIDE = 256
SIZE = 2048
SOLID = PerlinSpec(technique="perlin", frequency=8)
FRACTAL = PerlinSpec(technique="perlin", frequency=8, octaves=6)
RIDGED = PerlinSpec(technique="perlin", frequency=64, sum="ridged", octaves=4)
WAVES = GardnerSpec(technique="gardner", frequency=8, bandwidth=24, count=32, seed=1)
CELLS = WorleySpec(technique="worley", frequency=64)
BANDS = WaveletSpec(technique="wavelet", frequency=64)


def measure() -> list[dict[str, Any]]:
    """Measure ours beside each peer."""
    threads = numba.config.NUMBA_NUM_THREADS
    numba.set_num_threads(threads)
    space = grid(SIDE, 3)
    plane = grid(SIZE, 2)
    times = medians(
        {
            "solid, peer": lambda: fastnoiselite(1 / 32).gen_from_coords(space),
            "solid, 1": lambda: with_threads(1, lambda: volume(SOLID)),
            "solid": lambda: with_threads(threads, lambda: volume(SOLID)),
            "fractal": lambda: volume(FRACTAL),
            "memory": lambda: fill(np.empty((SIDE, SIDE, SIDE), np.float32)),
            "waves": lambda: gardner.synthesize(WAVES, (SIZE, SIZE), {}, silent),
            "cells": lambda: worley.synthesize(CELLS, (SIZE, SIZE), {}, silent),
            "bands": lambda: wavelet.synthesize(BANDS, (SIZE, SIZE), {}, silent),
            "ridged": lambda: perlin.synthesize(RIDGED, (SIZE, SIZE), {}, silent),
        },
        repeats=7,
    )
    times |= medians(
        {
            "fractal, peer": lambda: fastnoiselite(1 / 32, 6).gen_from_coords(space),
            "cells, peer": lambda: cellular().gen_from_coords(plane),
            "waves, numpy": waves_in_numpy,
        },
        repeats=2,
    )
    share = f"{times['memory'] / times['solid']:.0%} of write bandwidth"
    waves_share = f"{times['memory'] / (SIDE**3 / SIZE**2) / times['waves']:.0%} of write bandwidth"
    voxels, pixels = SIDE**3, SIZE**2
    return [
        row("Perlin 256³, one octave, pyfastnoiselite", voxels, times["solid, peer"]),
        row("the same, 1 thread", voxels, times["solid, 1"], times["solid, peer"]),
        row(
            "the same, all threads (reach: 1000 M/s)",
            voxels,
            times["solid"],
            times["solid, peer"],
            share,
        ),
        row("Perlin 256³, six octaves, pyfastnoiselite", voxels, times["fractal, peer"]),
        row("the same, all threads", voxels, times["fractal"], times["fractal, peer"]),
        row("Gardner 2048², 32 waves, numpy", pixels, times["waves, numpy"]),
        row(
            "the same, one product (reach: 15 ms)",
            pixels,
            times["waves"],
            times["waves, numpy"],
            waves_share,
        ),
        row("Worley 2048², 32 px per cell, pyfastnoiselite", pixels, times["cells, peer"]),
        row("the same, exact, all threads", pixels, times["cells"], times["cells, peer"]),
        row("wavelet 2048², one band of 128² coefficients", pixels, times["bands"]),
        row("ridged multifractal 2048², four octaves", pixels, times["ridged"]),
    ]


def row(
    work: str, count: int, seconds: float, theirs: float | None = None, note: str = ""
) -> dict[str, Any]:
    """One row of the table: milliseconds, with the rate and the ratio to a peer in the note."""
    notes = [f"{count / seconds / 1e6:.0f} M/s"]
    notes += [f"{theirs / seconds:.1f}x the peer"] if theirs else []
    notes += [note] if note else []
    return {
        "work": work,
        "figure": round(seconds * 1000, 2),
        "unit": "ms",
        "note": ", ".join(notes),
    }


def grid(side: int, axes: int) -> np.ndarray:
    """Coordinates of pixels or voxels as the peer takes them, (axes, n)."""
    return np.stack(np.meshgrid(*[np.arange(side, dtype=np.float32)] * axes)).reshape(axes, -1)


def cellular() -> FastNoiseLite:
    """Cell noise of the peer: euclidean distance to the nearest point."""
    noise = FastNoiseLite(seed=1)
    noise.noise_type = NoiseType.NoiseType_Cellular
    noise.frequency = 1 / 32
    noise.cellular_distance_function = CellularDistanceFunction.CellularDistanceFunction_Euclidean
    noise.cellular_return_type = CellularReturnType.CellularReturnType_Distance
    return noise


def volume(spec: PerlinSpec) -> object:
    """One solid tile."""
    return perlin.synthesize_volume(spec, (SIDE, SIDE, SIDE), {}, silent)


def waves_in_numpy() -> np.ndarray:
    """The sum of cosines, one wave after the other."""
    cycles, phases = gardner.waves_of(WAVES, 2)
    places = ((np.arange(SIZE) + 0.5) / SIZE).astype(np.float32)
    u, v = places, places[:, np.newaxis]
    total = np.zeros((SIZE, SIZE), np.float32)
    for (a, b, _), phase in zip(cycles, phases, strict=True):
        total += np.cos(np.float32(2 * np.pi) * (a * u + b * v) + np.float32(phase))
    return total / len(cycles)


@parallel_kernel
def fill(voxels: np.ndarray) -> None:
    """Write every voxel once."""
    for slice_ in prange(len(voxels)):
        voxels[slice_] = 1.0
