"""The light that arrives on a matt surface (T36), as white chalk shows it: E(n) / pi."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from worker import layouts
from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis import _pieces, _sphere, _squares
from worker.synthesis._environment import harmonics_of, taken, told
from worker.synthesis._harmonics import irradiance
from worker.synthesis._lobes import phong
from worker.synthesis._prefilter import Cubes, probes

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.irradiance import IrradianceSpec
    from worker.stages import Report

    Floats = NDArray[np.float64]

_COSINE = phong(1.0)
_ROWS = 64


def synthesize(
    spec: IrradianceSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Return E / pi for the normals of the layout `to`: three channels of colour, 0 elsewhere."""
    found: dict[str, Any] = {}
    coefficients, light = np.array(spec.coefficients), None
    if "environment" in inputs:
        source, found = taken(inputs["environment"], spec.layout, spec.broken_texels)
        coefficients = harmonics_of(source)
        light = _pieces.pieces(Cubes(source, _COSINE).faces(_COSINE))
        found |= _missed(coefficients, light)
    width, height = size
    pixels = np.zeros((height, width, 3), np.float32)
    middles = layouts.texel_middles(width, height).reshape(height, width, 2)
    for row in range(0, height, _ROWS):
        report(row / height, spec.method)
        normals, valid = layouts.direction(spec.to, middles[row : row + _ROWS].reshape(-1, 2))
        if spec.method == "sum" and light is not None:
            picture = np.ascontiguousarray(normals).reshape(-1, width, 3)
            shown = _squares.sums(light, _COSINE, picture).reshape(-1, 3)
        else:
            shown = np.maximum(irradiance(coefficients, normals) / math.pi, 0.0)
        rows = pixels[row : row + _ROWS]
        rows[:] = (shown * valid[:, np.newaxis]).reshape(rows.shape)
    return Outcome(Image(pixels, "colour"), report={**told(coefficients), **found})


def warm() -> None:
    """Compile the kernels."""
    _sphere.warm()
    _pieces.warm()
    _squares.warm()


def _missed(coefficients: Floats, light: _pieces.Pieces) -> dict[str, Any]:
    """Compare nine coefficients with the sum over all texels, in shares of the mean."""
    normals = probes(64)
    exact = _pieces.sums(light, _COSINE, normals, _pieces.EVERY_TEXEL).astype(np.float64)
    error = irradiance(coefficients, normals) / math.pi - exact
    mean = exact.mean()
    if not mean > 0:
        return {}
    return {
        "harmonics_error_rms": float(np.sqrt((error**2).mean()) / mean),
        "harmonics_error_max": float(np.abs(error).max() / mean),
    }
