"""Light from all around as many lamps, for surfaces that add it up direction by direction (T09)."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.environment import SKY_LAMPS, SKY_LAMPS_SIDE
from api_schemas.families import LayoutSpec
from api_schemas.layouts.cube import CubeSpec
from worker import layouts
from worker.images.mending import mended

Floats = NDArray[np.float64]

_CELLS = CubeSpec(technique="cube", arrangement="column", orientation="gl")


def lamps_of(pixels: NDArray[np.float32], layout: LayoutSpec) -> tuple[Floats, Floats]:
    """Return unit directions (n, 3) in which light shines, and the irradiance (n, 3) of each.

    All texels in one of 6 x 16 x 16 cells of a cube are one lamp at the middle of their light, so
    that none of it is lost; cells without texels are no lamps.

    Args:
        pixels: float32 (height, width, channels), linear; alpha is left out.
        layout: How directions lie on them.
    """
    light, _ = mended(pixels[..., : 3 if pixels.shape[2] >= 3 else 1])
    height, width = light.shape[:2]
    shining = np.broadcast_to(light, (height, width, 3)).reshape(-1, 3).astype(np.float64)
    directions, _ = layouts.direction(layout, layouts.texel_middles(width, height))
    solid = layouts.solid_angles(layout, width, height).ravel()
    cells = _cells(directions)

    def sums(values: Floats) -> Floats:
        parts = [np.bincount(cells, column, SKY_LAMPS) for column in values.T]
        return np.stack(parts, axis=1)

    power = shining * solid[:, np.newaxis]
    # Where all is dark or nearly so, the middle is that of the cell.
    weight = power.sum(axis=1) + 1e-6 * solid * max(float(shining.mean()), 1e-30)
    middles = sums(directions * weight[:, np.newaxis])
    length = np.linalg.norm(middles, axis=1)
    there = length > 0
    return middles[there] / length[there, np.newaxis], sums(power)[there]


def _cells(directions: Floats) -> NDArray[np.int64]:
    place = layouts.place(_CELLS, directions) * [SKY_LAMPS_SIDE, 6 * SKY_LAMPS_SIDE]
    last = [SKY_LAMPS_SIDE - 1, 6 * SKY_LAMPS_SIDE - 1]
    column, row = np.clip(np.floor(place), 0, last).astype(np.int64).T
    return np.asarray(row * SKY_LAMPS_SIDE + column)
