"""Perlin's gradient noise at single points, float64: what every faster form is tested against.

The gradient of a lattice point (i, j, k) is number p[p[p[i] + j] + k] of a list, p being a
permutation of 0..255. In 3D the list is Perlin's sixteen; in 2D it is one of `GRADIENTS`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Perlin 2002: the twelve edges of a cube; four of them repeated make sixteen.
GRADIENTS_3D = np.array(
    [
        (1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0),
        (1, 0, 1), (-1, 0, 1), (1, 0, -1), (-1, 0, -1),
        (0, 1, 1), (0, -1, 1), (0, 1, -1), (0, -1, -1),
        (1, 1, 0), (0, -1, 1), (-1, 1, 0), (0, -1, -1),
    ],
    dtype=np.float64,
)  # fmt: skip

_DIAGONAL = 0.5**0.5

# "reference" drops the z of the sixteen, which makes it the slice z = 0 of the 3D noise.
# "eight" are unit vectors 45 degrees apart, counter-clockwise from +u.
GRADIENTS_2D = {
    "reference": np.ascontiguousarray(GRADIENTS_3D[:, :2]),
    "eight": np.array(
        [
            (1, 0), (_DIAGONAL, _DIAGONAL), (0, 1), (-_DIAGONAL, _DIAGONAL),
            (-1, 0), (-_DIAGONAL, -_DIAGONAL), (0, -1), (_DIAGONAL, -_DIAGONAL),
        ],
        dtype=np.float64,
    ),
}  # fmt: skip

# The blend a(s) between lattice points is s (c1 + s (c2 + s (c3 + s (c4 + s c5)))).
FADES = {
    "quintic": np.array([0.0, 0.0, 10.0, -15.0, 6.0]),
    "cubic": np.array([0.0, 3.0, -2.0, 0.0, 0.0]),
    "linear": np.array([1.0, 0.0, 0.0, 0.0, 0.0]),
}


@kernel
def noise3(x: float, y: float, z: float, table: NDArray[np.int32]) -> float:
    """Evaluate improved noise (Perlin 2002) in Perlin's own order of operations; period 256.

    With the reference permutation noise3(3.14, 42, 7) is 0.13691995878400012.
    """
    i, j, k = math.floor(x), math.floor(y), math.floor(z)
    x, y, z = x - i, y - j, z - k
    u, v, w = _quintic(x), _quintic(y), _quintic(z)
    volume = 0.0
    for dk in range(2):
        plane = 0.0
        for dj in range(2):
            left = _corner3(x, y - dj, z - dk, i, j + dj, k + dk, table)
            right = _corner3(x - 1.0, y - dj, z - dk, i + 1, j + dj, k + dk, table)
            row = left + u * (right - left)
            plane = row if dj == 0 else plane + v * (row - plane)
        volume = plane if dk == 0 else volume + w * (plane - volume)
    return volume


@kernel
def noise2(
    x: float,
    y: float,
    layer: int,
    period: int,
    table: NDArray[np.int32],
    gradients: NDArray[np.float64],
    fade: NDArray[np.float64],
) -> float:
    """Evaluate 2D noise of an integer period; with "reference" it is noise3(x, y, layer).

    `table` is a permutation, `gradients` and `fade` are values of GRADIENTS_2D and FADES. The
    identity holds where the indices stay within the period and the fade is quintic.
    """
    i, j = math.floor(x), math.floor(y)
    x, y = x - i, y - j
    u, v = _blend(x, fade), _blend(y, fade)
    plane = 0.0
    for dj in range(2):
        left = _corner2(x, y - dj, i % period, (j + dj) % period, layer, table, gradients)
        right = _corner2(
            x - 1.0, y - dj, (i + 1) % period, (j + dj) % period, layer, table, gradients
        )
        row = left + u * (right - left)
        plane = row if dj == 0 else plane + v * (row - plane)
    return plane


@kernel
def hashed(i: int, j: int, k: int, table: NDArray[np.int32]) -> int:
    """Return the permuted number 0..255 of a lattice point; every index counts modulo 256."""
    number: int = table[(table[(table[i & 255] + j) & 255] + k) & 255]
    return number


@kernel
def _corner3(
    x: float, y: float, z: float, i: int, j: int, k: int, table: NDArray[np.int32]
) -> float:
    gradient = GRADIENTS_3D[hashed(i, j, k, table) & 15]
    value: float = gradient[0] * x + gradient[1] * y + gradient[2] * z
    return value


@kernel
def _corner2(
    x: float,
    y: float,
    i: int,
    j: int,
    layer: int,
    table: NDArray[np.int32],
    gradients: NDArray[np.float64],
) -> float:
    gradient = gradients[hashed(i, j, layer, table) & (len(gradients) - 1)]
    value: float = gradient[0] * x + gradient[1] * y
    return value


@kernel
def _quintic(s: float) -> float:
    return s * s * s * (s * (s * 6.0 - 15.0) + 10.0)


@kernel
def _blend(s: float, fade: NDArray[np.float64]) -> float:
    blend: float = s * (fade[0] + s * (fade[1] + s * (fade[2] + s * (fade[3] + s * fade[4]))))
    return blend


@kernel
def fill_fractal_noise_at(
    values: NDArray[np.float64],
    u: NDArray[np.float64],
    v: NDArray[np.float64],
    octaves: NDArray[np.float64],
    table: NDArray[np.int32],
    gradients: NDArray[np.float64],
    fade: NDArray[np.float64],
) -> None:
    """Write the weighted sum of octaves at points of the tile.

    A row of `octaves` is (cells, weight, layer, shift along u, shift along v), shifts in cells.
    """
    for point in range(len(values)):
        values[point] = 0.0
        for n in range(len(octaves)):
            cells, weight, layer, shift_u, shift_v = octaves[n]
            x, y = u[point] * cells + shift_u, v[point] * cells + shift_v
            noise = noise2(x, y, int(layer), int(cells), table, gradients, fade)
            values[point] += weight * noise
