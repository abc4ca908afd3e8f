"""Light gathered by a lobe for many directions, the quickest way that is good enough (T35)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from worker.synthesis import _pieces, _spiral, _squares
from worker.synthesis._conversion import cube_of
from worker.synthesis._cube import halved, pyramid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis._lobes import Lobe
    from worker.synthesis._sphere import Sphere

    Floats = NDArray[np.float64]

_SIDES = (64, 512)
_TEXELS_IN_A_LOBE = 6.0  # of those that are added up
_NARROW = 2.5  # texels; what is narrower is read between texels
_GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))


class Cubes:
    """An environment as cubes, each as fine as a lobe can tell apart."""

    def __init__(self, source: Sphere, narrowest: Lobe) -> None:
        """Bring the source to the finest cube that is needed."""
        height, width = source.pixels.shape[:2]
        self._there = math.sqrt(height * width / 6)
        side = self._side(narrowest)
        self._faces = {side: cube_of(source, side)}

    def faces(self, lobe: Lobe) -> NDArray[np.float32]:
        """Return the faces (6, side, side, 3) for a lobe no narrower than the narrowest."""
        side = self._side(lobe)
        while side not in self._faces:
            least = min(self._faces)
            self._faces[least // 2] = halved(self._faces[least])
        return self._faces[side]

    def _side(self, lobe: Lobe) -> int:
        useful = _TEXELS_IN_A_LOBE * (math.pi / 2) / lobe.width
        least, most = _SIDES
        return 1 << math.ceil(math.log2(min(max(min(self._there, useful), least), most)) - 1e-9)


def probes(count: int) -> Floats:
    """Return unit directions (count, 3), evenly spread over the sphere."""
    y = 1 - (2 * np.arange(count) + 1) / count
    angle = _GOLDEN_ANGLE * np.arange(count)
    across = np.sqrt(1 - y * y)
    return np.stack([across * np.cos(angle), y, across * np.sin(angle)], axis=1)


class Gatherer:
    """One environment, as one lobe sees it."""

    def __init__(self, cubes: Cubes, lobe: Lobe) -> None:
        """Take the cube that fits the lobe."""
        faces = cubes.faces(lobe)
        self.narrow = lobe.width < _NARROW * (math.pi / 2) / faces.shape[1]
        self._lobe = lobe
        self._pieces = _pieces.pieces(faces)
        self._pyramid = pyramid(faces) if self.narrow else None

    def gather(self, directions: Floats) -> NDArray[np.float32]:
        """Return the light (height, width, 3) round the unit directions of a picture's pixels."""
        if self._pyramid is not None:
            flat = _spiral.gathered(self._pyramid, self._lobe, directions.reshape(-1, 3))
            return flat.reshape(directions.shape)
        return _squares.sums(self._pieces, self._lobe, directions)

    def add_up(self, directions: Floats) -> NDArray[np.float32]:
        """Return the light (n, 3) round unit directions by brute force, of every texel (T09)."""
        return _pieces.sums(self._pieces, self._lobe, directions, _pieces.EVERY_TEXEL)
