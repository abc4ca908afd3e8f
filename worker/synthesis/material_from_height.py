"""Normals, occlusion, curvature, roughness and colour of one relief."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis._horizons import sky_seen
from worker.synthesis._horizons import warm as warm_horizons
from worker.synthesis._pointwise import held, wide

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.material_from_height import MaterialFromHeightSpec
    from worker.stages import Report

    Field = NDArray[np.float64]

_HIGHEST = 1e6


def synthesize(
    spec: MaterialFromHeightSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Return the colour of the relief `inputs["height"]`, and its other maps as layers."""
    heights = np.clip(wide(inputs["height"].pixels[..., 0]), -_HIGHEST, _HIGHEST)
    relief = heights * spec.depth
    along_u, along_v = slopes(relief)
    normals = np.stack([-along_u, -along_v, np.ones_like(relief)], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    report(0.1, "horizons")
    occlusion = sky_seen(relief, normals, spec.reach)
    report(0.9, "maps")
    shown = np.clip(0.5 - 0.5 * spec.curvature_radius * mean_curvature(relief), 0, 1)
    rough = np.interp(heights, [0, 1], spec.roughness)
    stops = sorted(spec.stops, key=lambda stop: stop.position)
    places = [stop.position for stop in stops]
    colour = np.stack(
        [np.interp(heights, places, [stop.color[i] for stop in stops]) for i in range(3)], axis=-1
    )
    colour *= (1 - spec.cavity + spec.cavity * occlusion)[..., np.newaxis]
    layers = {
        "height": heights,
        "normal": normals,
        "occlusion": occlusion,
        "curvature": shown,
        "roughness": rough,
    }
    return Outcome(
        Image(held(colour), spec.meaning),
        {
            name: Image(held(layer.reshape(*heights.shape, -1)), "data")
            for name, layer in layers.items()
        },
    )


def slopes(relief: Field) -> tuple[Field, Field]:
    """Return how fast a relief in tiles rises along u and v, by central differences."""
    height, width = relief.shape
    along_u = (np.roll(relief, -1, 1) - np.roll(relief, 1, 1)) * (width / 2)
    along_v = (np.roll(relief, 1, 0) - np.roll(relief, -1, 0)) * (height / 2)
    return along_u, along_v


def mean_curvature(relief: Field) -> Field:
    """Return the mean curvature, one over tiles, positive where the relief is hollow."""
    height, width = relief.shape
    u, v = slopes(relief)
    uu = (np.roll(relief, -1, 1) - 2 * relief + np.roll(relief, 1, 1)) * width**2
    vv = (np.roll(relief, -1, 0) - 2 * relief + np.roll(relief, 1, 0)) * height**2
    uv = slopes(u)[1]
    total = (1 + v * v) * uu - 2 * u * v * uv + (1 + u * u) * vv
    curvature: Field = total / (2 * (1 + u * u + v * v) ** 1.5)
    return curvature


def warm() -> None:
    """Compile the kernels."""
    warm_horizons()
