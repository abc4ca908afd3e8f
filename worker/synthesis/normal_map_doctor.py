"""Whether a normal map belongs to a relief, after Hughes et al., 2013, inline exercise 20.2.

A field of slopes (p, q) is that of a relief where its curl dq/du - dp/dv is 0 everywhere: then no
loop climbs. How far it is from one is told by the relief nearest to it (Frankot and Chellappa,
1988). A normal map with green the wrong way round is nearer to one when green is flipped.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from worker.images.image import Image
from worker.images.sampling import sample
from worker.outcome import Outcome
from worker.synthesis._pointwise import held, wide
from worker.synthesis.height_from_normal import integrated, slopes

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.normal_map_doctor import NormalMapDoctorSpec
    from worker.stages import Report

    Numbers = NDArray[np.float64]

LOOP_POINTS = 2000
_WRONG = 0.01
"""Share of energy above which slopes are no relief's: a hundred times what eight bits do."""
_CLEAR = 0.5
"""How much less it must be one way round than the other before green is judged."""


def synthesize(
    spec: NormalMapDoctorSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Examine `inputs["normal"]`: three channels of normals of the nearest relief."""
    along_u, along_v = slopes(inputs["normal"], spec.normal_range, spec.green)
    heights, lacking = integrated(along_u, along_v)
    report(0.4, "flip green")
    flipped = integrated(along_u, -along_v)[1]
    report(0.7, "find the curl")
    turning = curl(along_u, along_v)
    tilt = along_u.mean(), along_v.mean()
    relief_u, relief_v = _gradient(heights)
    relief_u, relief_v = relief_u + tilt[0], relief_v + tilt[1]
    residual = np.hypot(along_u - relief_u, along_v - relief_v)
    normals = np.stack([-relief_u, -relief_v, np.ones_like(relief_u)], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    told: dict[str, Any] = {
        "not_integrable": lacking,
        "not_integrable_flipped": flipped,
        "green": _judged(lacking, flipped),
        "curl": {"rms": _rms(turning), "largest": float(np.abs(turning).max())},
        "circulation": _round_the_middle(along_u, along_v, spec.loop_radius),
        "tilt": [float(mean) for mean in tilt],
    }
    layers = {"curl": turning, "height": heights, "residual": residual}
    pixels = normals / 2 + 0.5 if spec.range == "unit" else normals
    return Outcome(
        Image(held(pixels), spec.meaning),
        {name: Image(held(layer)[..., np.newaxis], "data") for name, layer in layers.items()},
        told | _lengths(inputs["normal"], spec.normal_range),
    )


def curl(along_u: Numbers, along_v: Numbers) -> Numbers:
    """Return dq/du - dp/dv per tile, by central differences over joined edges; row 0 is the top."""
    height, width = along_u.shape
    over_u = (np.roll(along_v, -1, axis=1) - np.roll(along_v, 1, axis=1)) * (width / 2)
    over_v = (np.roll(along_u, 1, axis=0) - np.roll(along_u, -1, axis=0)) * (height / 2)
    turning: Numbers = over_u - over_v
    return turning


def circulation(slopes_between: Numbers, corners: Numbers) -> float:
    """Return how far one has climbed after a closed way: the slopes times the steps, added up.

    Args:
        slopes_between: (n, 2), p and q halfway along each step.
        corners: (n, 2), u and v of the corners; the last step leads back to the first.
    """
    return float((slopes_between * (np.roll(corners, -1, axis=0) - corners)).sum())


def _round_the_middle(along_u: Numbers, along_v: Numbers, radius: float) -> float:
    angle = 2 * np.pi * np.arange(LOOP_POINTS) / LOOP_POINTS
    corners = 0.5 + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    between = (corners + np.roll(corners, -1, axis=0)) / 2
    found = [sample([held(slope)], between, ("repeat", "repeat")) for slope in (along_u, along_v)]
    return circulation(np.stack(found, axis=1), corners)


def _gradient(heights: Numbers) -> tuple[Numbers, Numbers]:
    """Return the exact slopes of the smoothest periodic function through heights."""
    height, width = heights.shape
    waves = np.fft.fft2(heights)
    k_u = 2j * np.pi * np.fft.fftfreq(width, 1 / width)
    k_v = -2j * np.pi * np.fft.fftfreq(height, 1 / height)[:, np.newaxis]
    return np.fft.ifft2(k_u * waves).real, np.fft.ifft2(k_v * waves).real


def _judged(lacking: float, flipped: float) -> str:
    less, more = sorted((lacking, flipped))
    if more < _WRONG or less > _CLEAR * more:
        return "cannot_tell"
    return "as_said" if lacking < flipped else "flipped"


def _lengths(image: Image, normal_range: str) -> dict[str, Any]:
    normals = wide(image.pixels[..., :3])
    if normal_range == "unit":
        normals = 2 * normals - 1
    length = np.sqrt((normals * normals).sum(axis=-1))
    upwards = normals[..., 2] > 0 if image.channels > 2 else np.ones(length.shape, bool)
    return {
        "length": {
            "least": float(length.min()),
            "mean": float(length.mean()),
            "largest": float(length.max()),
        },
        "not_upwards": float(1 - upwards.mean()),
    }


def _rms(values: Numbers) -> float:
    largest = float(np.abs(values).max())
    return largest * math.sqrt(float(((values / largest) ** 2).mean())) if largest else 0.0
