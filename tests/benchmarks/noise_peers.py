"""Peers of PyPI that make a picture of gradient noise, each in its own quickest way.

pyfastnoiselite is in the lock. The others are measured where NOISE_PEERS names a folder with them:
`pip install --no-deps --target <folder> opensimplex==0.4.5.1 noise==1.2.2`. They are in no lock:
opensimplex brings a package `tests` that would hide ours, and noise wants a compiler. vnoise 0.1.0
cannot be imported where setuptools has no pkg_resources any more.
"""

import importlib
import os
import sys
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import numpy as np
from pyfastnoiselite.pyfastnoiselite import FastNoiseLite, FractalType, NoiseType


def pictures(side: int, cells: int) -> dict[str, Callable[[], object]]:
    """Return what makes one octave of (side, side) pixels with so many cells, by peer."""
    fast = fastnoiselite(cells / side)
    coordinates = np.stack(np.meshgrid(*[np.arange(side, dtype=np.float32)] * 2)).reshape(2, -1)
    along = np.arange(side) * (cells / side)
    if folder := os.environ.get("NOISE_PEERS"):
        sys.path.append(folder)
    found: dict[str, Callable[[], object]] = {
        "pyfastnoiselite": lambda: fast.gen_from_coords(coordinates)
    }
    if simplex := _installed("opensimplex"):
        found["opensimplex"] = lambda: simplex.noise2array(along, along)
    if points := _installed("noise"):
        found["noise"] = lambda: [points.pnoise2(x, y) for y in along for x in along]
    return found


def fastnoiselite(frequency: float, octaves: int = 1) -> FastNoiseLite:
    """Perlin noise of pyfastnoiselite."""
    peer = FastNoiseLite(seed=1)
    peer.noise_type = NoiseType.NoiseType_Perlin
    peer.frequency = frequency
    if octaves > 1:
        peer.fractal_type = FractalType.FractalType_FBm
        peer.fractal_octaves = octaves
    return peer


def _installed(name: str) -> Any:
    return importlib.import_module(name) if find_spec(name) else None
