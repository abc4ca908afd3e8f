"""Solid wavelet noise at single points: cut there, or projected onto a plane (Cook and DeRose)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]

_CHUNK = 1024


@parallel_kernel
def fill_cut_at(values: Numbers, places: Numbers, coefficients: NDArray[np.float32]) -> None:
    """Add the noise at places (n, 3), u, v and w in coefficients, to the values."""
    side = len(coefficients)
    for chunk in prange((len(values) + _CHUNK - 1) // _CHUNK):
        for n in range(chunk * _CHUNK, min(len(values), (chunk + 1) * _CHUNK)):
            u, v, w = places[n]
            i, j, k = int(np.ceil(u - 1.5)), int(np.ceil(v - 1.5)), int(np.ceil(w - 1.5))
            total = 0.0
            for c in range(k, k + 4):
                for b in range(j, j + 4):
                    weight = _spline(w - c + 1.5) * _spline(v - b + 1.5)
                    for a in range(i, i + 4):
                        coefficient = coefficients[c % side, b % side, a % side]
                        total += weight * _spline(u - a + 1.5) * coefficient
            values[n] += total


@parallel_kernel
def fill_projected_at(
    values: Numbers, places: Numbers, normals: Numbers, coefficients: NDArray[np.float32]
) -> None:
    """Add the noise projected along unit normals (n, 3) to the values; places as in `fill_cut_at`.

    A coefficient is moved half way to the plane, and then weighted by the spline round the place.
    """
    side = len(coefficients)
    for chunk in prange((len(values) + _CHUNK - 1) // _CHUNK):
        for n in range(chunk * _CHUNK, min(len(values), (chunk + 1) * _CHUNK)):
            u, v, w = places[n]
            x, y, z = normals[n]
            reach_u, reach_v, reach_w = _reach(x), _reach(y), _reach(z)
            total = 0.0
            for c in range(int(np.ceil(w - reach_w)), int(np.floor(w + reach_w)) + 1):
                for b in range(int(np.ceil(v - reach_v)), int(np.floor(v + reach_v)) + 1):
                    for a in range(int(np.ceil(u - reach_u)), int(np.floor(u + reach_u)) + 1):
                        away = (x * (u - a) + y * (v - b) + z * (w - c)) / 2
                        weight = _spline(a + x * away - u + 1.5)
                        if weight > 0:
                            weight *= _spline(b + y * away - v + 1.5)
                            weight *= _spline(c + z * away - w + 1.5)
                            total += weight * coefficients[c % side, b % side, a % side]
            values[n] += total


@kernel
def _reach(normal: float) -> float:
    """Return how far along an axis coefficients may lie, for that component of the normal."""
    along = abs(normal)
    reach: float = 3 * along + 3 * np.sqrt(max(1 - along * along, 0.0) / 2)
    return reach


@kernel
def _spline(t: float) -> float:
    if t <= 0 or t >= 3:
        return 0.0
    if t < 1:
        return t * t / 2
    if t < 2:
        return 1 - ((t - 1) * (t - 1) + (2 - t) * (2 - t)) / 2
    return (3 - t) * (3 - t) / 2
