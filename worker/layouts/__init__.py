"""Layouts: the module named after a technique knows where on a picture each direction lies.

Directions are in the world, right-handed with y up; places are (u, v) with v up. Every module has

    def place(spec, directions) -> uv                      float64 (n, 3) -> (n, 2)
    def direction(spec, uv) -> (directions, valid)         float64 (n, 2) -> (n, 3), bool (n,)
    def solid_angles(spec, width, height) -> steradians    float64 (height, width), row 0 on top

The shader chunks of the same names compute the same.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, cast

import numpy as np

from worker.images.spreading import spread

if TYPE_CHECKING:
    from types import ModuleType

    from numpy.typing import NDArray

    from api_schemas.families import LayoutSpec

    Numbers = NDArray[np.float64]


def place(spec: LayoutSpec, directions: Numbers) -> Numbers:
    """Return where on the picture directions lie.

    Args:
        spec: A layout of any technique.
        directions: float64 (n, 3), of any length but zero.

    Returns:
        float64 (n, 2): u to the right and v up, 0..1.
    """
    return cast("Numbers", _module(spec).place(spec, directions))


def direction(spec: LayoutSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the unit directions that lie at places, float64 (n, 3), and which places hold any.

    Places that hold none, as the corners round a disc, have the direction of a place near by.
    """
    return cast("tuple[Numbers, NDArray[np.bool_]]", _module(spec).direction(spec, uv))


def solid_angles(spec: LayoutSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel in steradians, float64 (height, width).

    Row 0 is the top; together they are the directions the layout holds, 4 pi if it holds all.
    """
    return cast("Numbers", _module(spec).solid_angles(spec, width, height))


def filled(spec: LayoutSpec, pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Draw what a layout holds out over the rest of a picture (height, width, channels).

    So nothing of the corners round a disc bleeds into it when texels are blended.
    """
    if spec.whole:
        return pixels
    height, width, _ = pixels.shape
    _, valid = direction(spec, texel_middles(width, height))
    return spread(pixels, valid.reshape(height, width))


def texel_middles(width: int, height: int) -> Numbers:
    """Return the places of all texels' middles, float64 (height * width, 2), the top row first."""
    u = (np.arange(width) + 0.5) / width
    v = 1 - (np.arange(height) + 0.5) / height
    return np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)


def _module(spec: LayoutSpec) -> ModuleType:
    return importlib.import_module(f"{__name__}.{spec.technique}")
