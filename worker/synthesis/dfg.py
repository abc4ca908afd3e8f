"""Reflectance of GGX microfacets under a uniform sky (Karis, 2013, after Walter et al., 2007).

For a half vector h that leans by alpha t in the direction phi, D(h) n.h dh is
t / (pi (1 + t^2)^2) dt dphi, so that with the height-correlated shadowing G of Heitz (2014)

    A + B = int G (v.h) / ((n.v) (n.h)) D(h) n.h dh over those h that mirror v above the horizon,

and B has (1 - v.h)^5 in it besides. For each phi the horizon is at a polar angle known in closed
form. Gauss and Legendre's points lie in phi on both sides of a right angle, and in asinh t, where
the tail of GGX decays exponentially. All values are within 2e-5.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.dfg import DfgSpec

    Floats = NDArray[np.float64]

    from worker.stages import Report

_SLOPES, _DIRECTIONS = 24, 12
_SMOOTHEST = 1e-6  # alpha; of a mirror, seven digits are the same
_GRAZING = 1e-4  # n.v; at 0 itself the integral is a limit


def synthesize(
    spec: DfgSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Tabulate A, B and A + B over n.v (u) and roughness (v): three channels of data."""
    width, height = size
    pixels = np.empty((height, width, 3), np.float32)
    cosines, roughness = _places(width, spec.span), _places(height, spec.span)[::-1]
    _fill_table(pixels, cosines, roughness.copy(), *_points(_SLOPES), *_points(_DIRECTIONS))
    return Image(pixels, spec.meaning)


def reflectance(roughness: float, cosine: float) -> tuple[float, float]:
    """Return A and B at one roughness and one cosine of the viewing angle, both 0..1."""
    found = np.empty(2)
    _integrate(found, cosine, roughness, *_points(_SLOPES), *_points(_DIRECTIONS))
    return float(found[0]), float(found[1])


def warm() -> None:
    """Compile the kernels."""
    _fill_table(np.empty((1, 1, 3), np.float32), np.ones(1), np.ones(1), *_points(2), *_points(2))


def _places(count: int, span: str) -> Floats:
    if span == "centres" or count == 1:
        return (np.arange(count) + 0.5) / count
    return np.arange(count) / (count - 1)


def _points(count: int) -> tuple[Floats, Floats]:
    """Give Gauss and Legendre's points and weights on 0..1."""
    points, weights = np.polynomial.legendre.leggauss(count)
    return (points + 1) / 2, weights / 2


@parallel_kernel
def _fill_table(
    pixels: NDArray[np.float32],
    cosines: Floats,
    roughness: Floats,
    slopes: Floats,
    slope_weights: Floats,
    directions: Floats,
    direction_weights: Floats,
) -> None:
    for row in prange(len(roughness)):
        found = np.empty(2)
        for column in range(len(cosines)):
            _integrate(
                found,
                cosines[column],
                roughness[row],
                slopes,
                slope_weights,
                directions,
                direction_weights,
            )
            pixels[row, column, 0] = found[0]
            pixels[row, column, 1] = found[1]
            pixels[row, column, 2] = found[0] + found[1]


@kernel
def _integrate(
    found: Floats,
    cosine: float,
    roughness: float,
    slopes: Floats,
    slope_weights: Floats,
    directions: Floats,
    direction_weights: Floats,
) -> None:
    """Fill in A and B."""
    alpha = max(roughness * roughness, _SMOOTHEST)
    view_z = max(cosine, _GRAZING)
    view_x = math.sqrt(1 - view_z * view_z)
    shadow_view = math.sqrt(view_z * view_z * (1 - alpha * alpha) + alpha * alpha)
    found[0] = found[1] = 0.0
    for half in range(2):
        for i in range(len(directions)):
            phi = (directions[i] + half) * math.pi / 2
            # 2 (v.h) h.z > v.z is cos(2 theta - psi) > 0 with tan psi = v.x cos(phi) / v.z
            horizon = (math.pi / 2 + math.atan2(view_x * math.cos(phi), view_z)) / 2
            reach = math.asinh(math.tan(horizon) / alpha)
            for j in range(len(slopes)):
                power = math.exp(slopes[j] * reach)
                slope, stretch = (power - 1 / power) / 2, (power + 1 / power) / 2
                half_z = 1 / math.sqrt(1 + alpha * alpha * slope * slope)
                half_x = alpha * slope * half_z * math.cos(phi)
                view_half = view_x * half_x + view_z * half_z
                light_z = max(2 * view_half * half_z - view_z, 0.0)
                shadow_light = math.sqrt(light_z * light_z * (1 - alpha * alpha) + alpha * alpha)
                both = view_z * shadow_light + light_z * shadow_view
                weight = direction_weights[i] * slope_weights[j] * reach
                weight *= slope / (stretch * stretch * stretch)
                value = weight * 2 * light_z / both * view_half / half_z
                rest = 1 - min(view_half, 1.0)
                fresnel = rest * rest * rest * rest * rest
                found[0] += value * (1 - fresnel)
                found[1] += value * fresnel
