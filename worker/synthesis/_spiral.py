"""Light in a narrow lobe, read along a spiral of directions (T35).

A fixed spiral is drawn from the lobe, and each direction reads the environment at the level whose
texels are as large as its share of the lobe (Krivanek and Colbert, 2008): no noise, and weights
whose sum is 1 keep a constant environment constant.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._cube import add_light, pyramid
from worker.synthesis._lobes import GGX, phong

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis._cube import Pyramid
    from worker.synthesis._lobes import Lobe

    Floats = NDArray[np.float64]

_SAMPLES = 256
_GOLDEN = (math.sqrt(5) - 1) / 2


def gathered(light: Pyramid, lobe: Lobe, directions: Floats) -> NDArray[np.float32]:
    """Return what a lobe round each unit direction (n, 3) gathers: float32 (n, 3)."""
    cosine, weights, density = _ggx(lobe.sharpness) if lobe.kind == GGX else _phong(lobe.sharpness)
    angle = 2 * math.pi * ((np.arange(_SAMPLES) * _GOLDEN) % 1)
    sine = np.sqrt(np.maximum(1 - cosine * cosine, 0))
    samples = np.stack([sine * np.cos(angle), sine * np.sin(angle), cosine], axis=1)
    texel = 4 * math.pi / (6 * float(light.sides[0]) ** 2)
    levels = -0.5 * np.log2(np.maximum(_SAMPLES * density * texel, 1e-30))
    found = np.empty((len(directions), 3), np.float32)
    _gather(found, light, samples, weights / weights.sum(), levels, directions)
    return found


def warm() -> None:
    """Compile the kernels."""
    gathered(pyramid(np.zeros((6, 2, 2, 3), np.float32)), phong(1.0), np.eye(3))


def _ggx(alpha: float) -> tuple[Floats, Floats, Floats]:
    """Return cosine to the middle, weight and density of directions drawn from D(h)."""
    a2 = alpha * alpha
    # Half vectors up to 45 degrees mirror to above the horizon.
    u = (np.arange(_SAMPLES) + 0.5) / _SAMPLES / (1 + a2)
    squared = (1 - u) / (1 + (a2 - 1) * u)
    density = (1 + a2) * a2 / (4 * math.pi * (squared * (a2 - 1) + 1) ** 2)
    cosine = 2 * squared - 1
    shadowed = cosine / (cosine + np.sqrt(cosine * cosine * (1 - a2) + a2))
    return cosine, shadowed, density


def _phong(exponent: float) -> tuple[Floats, Floats, Floats]:
    u = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    cosine = (1 - u) ** (1 / (exponent + 1))
    return cosine, np.ones(_SAMPLES), (exponent + 1) / (2 * math.pi) * cosine**exponent


@parallel_kernel
def _gather(
    found: NDArray[np.float32],
    light: Pyramid,
    samples: Floats,
    weights: Floats,
    levels: Floats,
    directions: Floats,
) -> None:
    for block in prange((len(directions) + 63) // 64):
        total = np.empty(3)
        for index in range(block * 64, min(block * 64 + 64, len(directions))):
            total[:] = 0.0
            _gather_one(total, light, samples, weights, levels, directions[index])
            for channel in range(3):
                found[index, channel] = total[channel]


@kernel
def _gather_one(
    total: Floats,
    light: Pyramid,
    samples: Floats,
    weights: Floats,
    levels: Floats,
    direction: Floats,
) -> None:
    """Turn the lobe so that its +z is the direction (frame of Duff et al., 2017)."""
    x, y, z = direction[0], direction[1], direction[2]
    sign = 1.0 if z >= 0 else -1.0
    a = -1 / (sign + z)
    b = x * y * a
    for i in range(len(weights)):
        s, t, r = samples[i, 0], samples[i, 1], samples[i, 2]
        add_light(
            total,
            light,
            levels[i],
            s * (1 + sign * x * x * a) + t * b + r * x,
            s * sign * b + t * (sign + y * y * a) + r * y,
            -s * sign * x - t * y + r * z,
            weights[i],
        )
