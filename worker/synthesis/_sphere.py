"""Pictures of all directions: read towards a direction, weighed by solid angle.

What lies outside of a picture's disc, or across the edge between two of its pieces, takes no part
in a blend: a texel counts only where its own direction is near the one that is asked for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worker import layouts
from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.families import LayoutSpec

    Floats = NDArray[np.float64]
    Pixels = NDArray[np.float32]

PLACES = 1 << 18
"""Directions worked on at a time."""

_WHOLE = 1e-3  # share of 4 pi by which a layout of all directions may miss it
_NEAR = 12.0  # mean texel sizes; beside a rim texels are long, across an edge they are far apart


@dataclass(frozen=True, slots=True)
class Measured:
    """Light times solid angle, three numbers, and the solid angle in steradians."""

    power: Floats
    steradians: float

    @property
    def mean(self) -> Floats:
        """The mean light."""
        return self.power / self.steradians

    @property
    def whole(self) -> bool:
        """Whether these are all directions."""
        return abs(self.steradians / (4 * math.pi) - 1) < _WHOLE


@dataclass(frozen=True, slots=True)
class Sphere:
    """A picture of light from all directions.

    Attributes:
        pixels: float32 (height, width, 3), linear, finite and not negative.
        layout: Where directions lie on it.
    """

    pixels: Pixels
    layout: LayoutSpec

    def solid_angles(self) -> Floats:
        """Return the solid angle (height, width) of each texel in steradians."""
        height, width = self.pixels.shape[:2]
        return layouts.solid_angles(self.layout, width, height)

    def measured(self) -> Measured:
        """Add up the light and the solid angle of all texels."""
        solid = self.solid_angles()
        power = [np.vdot(self.pixels[..., channel], solid) for channel in range(3)]
        return Measured(np.array(power), float(solid.sum()))

    def directions(self) -> Floats:
        """Return the unit directions (height * width, 3) of texels' middles, the top row first."""
        height, width = self.pixels.shape[:2]
        return layouts.direction(self.layout, layouts.texel_middles(width, height))[0]


class Reader:
    """Reads one sphere, many directions at a time."""

    def __init__(self, sphere: Sphere) -> None:
        """Learn where the texels of the sphere are."""
        height, width = sphere.pixels.shape[:2]
        self._sphere = sphere
        self._repeat = np.array([join == "repeat" for join in sphere.layout.joins])
        self._near = math.cos(min(_NEAR * math.sqrt(4 * math.pi / (width * height)), math.pi / 3))
        self._middles = np.empty((0, 0, 3), np.float32)
        if not self._repeat.any():
            places = layouts.texel_middles(width, height)
            middles, valid = layouts.direction(sphere.layout, places)
            middles[~valid] = 0.0
            self._middles = middles.reshape(height, width, 3).astype(np.float32)

    def read(self, directions: Floats) -> Floats:
        """Return the light (n, 3) towards unit directions (n, 3), blended between texels."""
        found = np.empty((len(directions), 3))
        for start in range(0, len(directions), PLACES):
            part = slice(start, start + PLACES)
            places = layouts.place(self._sphere.layout, directions[part])
            pixels = self._sphere.pixels
            towards = np.ascontiguousarray(directions[part])
            _blend(found[part], pixels, self._middles, places, towards, self._near, self._repeat)
        return found


@parallel_kernel
def _blend(
    found: Floats,
    pixels: Pixels,
    middles: NDArray[np.float32],
    places: Floats,
    directions: Floats,
    near: float,
    repeat: NDArray[np.bool_],
) -> None:
    for block in prange((len(places) + 1023) // 1024):
        for index in range(block * 1024, min(block * 1024 + 1024, len(places))):
            _blend_one(
                found[index], pixels, middles, places[index], directions[index], near, repeat
            )


@kernel
def _blend_one(
    found: Floats,
    pixels: Pixels,
    middles: NDArray[np.float32],
    place: Floats,
    direction: Floats,
    near: float,
    repeat: NDArray[np.bool_],
) -> None:
    height, width = pixels.shape[:2]
    x, y = place[0] * width - 0.5, (1 - place[1]) * height - 0.5
    left, top = math.floor(x), math.floor(y)
    total = 0.0
    found[:] = 0.0
    for tap in range(4):
        right, below = tap & 1, tap >> 1
        weight = (x - left if right else 1 - (x - left)) * (y - top if below else 1 - (y - top))
        column = _joined(left + right, width, repeat[0])
        row = _joined(top + below, height, repeat[1])
        if len(middles) > 0:
            middle = middles[row, column]
            dot = middle[0] * direction[0] + middle[1] * direction[1] + middle[2] * direction[2]
            if dot < near:
                continue
        total += weight
        for channel in range(3):
            found[channel] += weight * pixels[row, column, channel]
    if total > 0:
        for channel in range(3):
            found[channel] /= total
    else:
        column = _joined(math.floor(x + 0.5), width, repeat[0])
        row = _joined(math.floor(y + 0.5), height, repeat[1])
        for channel in range(3):
            found[channel] = pixels[row, column, channel]


@kernel
def _joined(index: int, count: int, repeat: bool) -> int:
    return index % count if repeat else min(max(index, 0), count - 1)


def warm() -> None:
    """Compile the kernels."""
    pixels, one = np.zeros((1, 1, 3), np.float32), np.zeros((1, 3))
    _blend(one, pixels, pixels, np.zeros((1, 2)), one, 1.0, np.zeros(2, bool))
