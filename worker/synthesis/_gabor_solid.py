"""Gabor kernels in space: their directions, their variance, and voxels full of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import parallel_kernel, prange
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._gabor_rows import CUT, add, tabulate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.textures.gabor import GaborSpec

    Numbers = NDArray[np.float64]


class SolidImpulses(NamedTuple):
    """Where kernels are, (n, 3) in tiles, the waves' unit vectors, (n, 3), and weights, (n,)."""

    places: Numbers
    directions: Numbers
    weights: Numbers


def solid_impulses(spec: GaborSpec) -> SolidImpulses:
    """Strew the kernels of a tile; within the spread every direction is as likely."""
    ball = 4 / 3 * np.pi * CUT**3
    count = max(1, round(spec.impulses * spec.bandwidth**3 / ball))
    u, v, w, turn, sign, round_it = (uniforms(spec.seed, use, count) for use in range(6))
    cosine = 1 - turn * (1 - np.cos(spec.spread))
    sine = np.sqrt(np.maximum(1 - cosine * cosine, 0))
    angle = 2 * np.pi * round_it
    ahead = np.array([np.cos(spec.orientation), np.sin(spec.orientation), 0])
    aside = np.array([-np.sin(spec.orientation), np.cos(spec.orientation), 0])
    directions = np.outer(cosine, ahead) + np.outer(sine * np.cos(angle), aside)
    directions[:, 2] += sine * np.sin(angle)
    return SolidImpulses(np.stack([u, v, w], axis=1), directions, np.where(sign < 0.5, -1.0, 1.0))


def solid_energy(frequency: float, bandwidth: float) -> float:
    """Return the integral of the squared kernel over space, in the units of 1 / bandwidth^3."""
    waves = 1 + np.exp(-2 * np.pi * (frequency / bandwidth) ** 2)
    return float(waves / (2**2.5 * bandwidth**3))


@parallel_kernel
def fill_solid_kernels(
    values: Numbers, impulses: SolidImpulses, frequency: float, bandwidth: float
) -> None:
    """Add all kernels to (depth, height, width); each slice takes them in the same order."""
    depth, height, width = values.shape
    reach = CUT / bandwidth
    for s in prange(depth):
        columns = int(2 * reach * width) + 2
        cosines, sines = np.empty(columns), np.empty(columns)
        for n in range(len(impulses.weights)):
            u, v, w = impulses.places[n]
            along, up, deep = frequency * impulses.directions[n]
            first = int(np.ceil((u - reach) * width - 0.5))
            last = int(np.floor((u + reach) * width - 0.5))
            behind = (s + 0.5) / depth - w
            made = False
            for turn in range(int(np.ceil(-reach - behind)), int(np.floor(reach - behind)) + 1):
                if not made:
                    tabulate(cosines, sines, first, last, u, width, along, bandwidth)
                    made = True
                z = behind + turn
                slice_weight = impulses.weights[n] * np.exp(-np.pi * (bandwidth * z) ** 2)
                for row in range(height):
                    below = 1 - (row + 0.5) / height - v
                    for copy in range(
                        int(np.ceil(-reach - below)), int(np.floor(reach - below)) + 1
                    ):
                        y = below + copy
                        under = slice_weight * np.exp(-np.pi * (bandwidth * y) ** 2)
                        angle = 2 * np.pi * (up * y + deep * z)
                        a, b = under * np.cos(angle), under * np.sin(angle)
                        add(values[s, row], first, last - first + 1, a, b, cosines, sines)
