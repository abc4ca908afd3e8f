"""The relief nearest to a normal map (Frankot and Chellappa, 1988), over joined edges.

Of all periodic reliefs it is the one whose slopes differ least in the sum of squares: in the space
of frequencies the slopes (P, Q) are projected on the direction (k_u, k_v).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis._pointwise import held, wide

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.height_from_normal import HeightFromNormalSpec
    from worker.stages import Report

_STEEPEST = 256.0
"""Slopes beyond are held there: what points sideways or down is no relief's."""


def synthesize(
    spec: HeightFromNormalSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Integrate the normals of `inputs["normal"]`: one channel of heights.

    The report tells the mean slopes, and of the others the share that no relief has.
    """
    along_u, along_v = slopes(inputs["normal"], spec.normal_range, spec.green)
    heights, lacking = integrated(along_u, along_v)
    pixels = heights / spec.depth + (0.5 if spec.range == "unit" else 0.0)
    tilt = [float(along_u.mean()), float(along_v.mean())]
    return Outcome(
        Image(held(pixels)[..., np.newaxis], spec.meaning),
        report={"not_integrable": lacking, "tilt": tilt},
    )


def integrated(
    along_u: NDArray[np.float64], along_v: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """Return the relief of mean 0 nearest to slopes, and the share of their energy it lacks.

    Slopes are heights in tiles per tile, (height, width), row 0 the top; their means, which no
    tile can have, and waves of two pixels, whose slope no pixel shows, do not count.
    """
    height, width = along_u.shape
    k_u = 2 * np.pi * _swings(width)
    k_v = -2 * np.pi * _swings(height)[:, np.newaxis]  # rows run against v
    waves_u, waves_v = np.fft.fft2(along_u), np.fft.fft2(along_v)
    square = k_u * k_u + k_v * k_v
    shown = square > 0
    whole = ((np.abs(waves_u) ** 2 + np.abs(waves_v) ** 2) * shown).sum()
    along = k_u * waves_u + k_v * waves_v
    square[~shown] = np.inf
    kept = (np.abs(along) ** 2 / square).sum()
    heights: NDArray[np.float64] = np.fft.ifft2(-1j * along / square).real
    return heights, float(max(0.0, 1 - kept / whole)) if whole > 0 else 0.0


def _swings(length: int) -> NDArray[np.float64]:
    """Return the swings per tile of each wave, 0 for the one that swings within two pixels."""
    swings: NDArray[np.float64] = np.fft.fftfreq(length, 1 / length).astype(np.float64)
    if length % 2 == 0:
        swings[length // 2] = 0
    return swings


def slopes(
    image: Image, normal_range: str, green: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the slopes along u and v of the relief that a normal map's normals stand on."""
    normals = np.zeros((image.height, image.width, 3))
    normals[..., : min(image.channels, 3)] = wide(image.pixels[..., :3])
    if image.channels < 3:
        normals[..., 2] = 1.0 if normal_range == "signed" else 0.5
    if normal_range == "unit":
        normals = 2 * normals - 1
    least = np.linalg.norm(normals, axis=-1) / _STEEPEST
    out = np.maximum(normals[..., 2], np.maximum(least, np.finfo(np.float64).tiny))
    up = -1 if green == "up" else 1
    return -normals[..., 0] / out, up * normals[..., 1] / out
