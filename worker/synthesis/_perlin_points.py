"""Perlin's gradient noise at single points, float64: what every faster form is tested against.

The gradient of a lattice point (i, j, k) is number p[p[p[i] + j] + k] of a list, p being a
permutation of 0..255; time adds another level. In 3D the list is Perlin's sixteen.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]

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

# The 32 edges of a hypercube: each triple of axes with all eight signs, in the manner of Perlin's
# own code for time, which however takes the axes y, z, t twice and x, y, z never.
GRADIENTS_4D = np.array(
    [
        [
            0.0 if axis == left_out else (1.0 if signs >> (axis - (axis > left_out)) & 1 else -1.0)
            for axis in range(4)
        ]
        for left_out in (3, 0, 1, 2)
        for signs in range(8)
    ]
)

# By what a gradient list is for, with four components each: as many as gradient_noise has axes
GRADIENTS = {
    **{name: np.pad(vectors, ((0, 0), (0, 2))) for name, vectors in GRADIENTS_2D.items()},
    "solid": np.pad(GRADIENTS_3D, ((0, 0), (0, 1))),
    "time": GRADIENTS_4D,
}

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
def gradient_noise(
    place: Numbers,
    axes: int,
    layer: int,
    period: int,
    beats: int,
    table: NDArray[np.int32],
    gradients: Numbers,
    fade: Numbers,
    slope: Numbers,
    work: Numbers,
) -> float:
    """Evaluate noise with integer periods along 2, 3 or 4 axes, and its derivatives.

    Args:
        place: In cells, (4,); the fourth is time. Axes beyond `axes` are not looked at.
        axes: 2 for a plane: noise in space at w = `layer`, if the gradients are its.
        layer: Added to the third lattice index.
        period: Cells until it repeats along u, v and w.
        beats: Cells until it repeats along time.
        table: A permutation.
        gradients: One of GRADIENTS, of a power of two.
        fade: One of FADES.
        slope: (4,), is filled with the derivatives by place.
        work: (4, 4), is overwritten.
    """
    cell, offset, blend, growth = work[0], work[1], work[2], work[3]
    for axis in range(axes):
        cell[axis] = math.floor(place[axis])
        s = place[axis] - cell[axis]
        offset[axis] = s
        blend[axis] = s * (fade[0] + s * (fade[1] + s * (fade[2] + s * (fade[3] + s * fade[4]))))
        growth[axis] = fade[0] + s * (
            2 * fade[1] + s * (3 * fade[2] + s * (4 * fade[3] + s * 5 * fade[4]))
        )
    value = 0.0
    slope[:] = 0.0
    mask = len(gradients) - 1
    for corner in range(1 << axes):
        i = (int(cell[0]) + (corner & 1)) % period
        j = (int(cell[1]) + (corner >> 1 & 1)) % period
        k = (int(cell[2]) + (corner >> 2 & 1)) % period if axes > 2 else 0
        number = hashed(i, j, k + layer, table)
        if axes > 3:
            number = table[(number + (int(cell[3]) + (corner >> 3)) % beats) & 255]
        gradient = gradients[number & mask]
        height, weight = 0.0, 1.0
        for axis in range(axes):
            upper = corner >> axis & 1
            height += gradient[axis] * (offset[axis] - upper)
            weight *= blend[axis] if upper else 1 - blend[axis]
        value += weight * height
        for axis in range(axes):
            others = 1.0
            for other in range(axes):
                if other != axis:
                    others *= blend[other] if corner >> other & 1 else 1 - blend[other]
            rise = growth[axis] if corner >> axis & 1 else -growth[axis]
            slope[axis] += weight * gradient[axis] + height * others * rise
    return value


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
def _quintic(s: float) -> float:
    return s * s * s * (s * (s * 6.0 - 15.0) + 10.0)
