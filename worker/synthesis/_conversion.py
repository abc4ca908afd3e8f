"""Light brought from one layout to another, its energy kept (T08)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worker import layouts
from worker.stages import silent
from worker.synthesis._cube import face_directions, face_solid_angles
from worker.synthesis._sphere import PLACES, Reader, Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.families import LayoutSpec
    from worker.stages import Report

    Floats = NDArray[np.float64]

_FINEST = 16


@dataclass(frozen=True, slots=True)
class Conversion:
    """A sphere in another layout.

    Attributes:
        sphere: The picture.
        before: Light of the source summed over the sphere, three numbers.
        after: The same of the picture.
        gain: What each channel was multiplied by to make them equal.
        whole: Whether both layouts hold all directions, so that they can be.
    """

    sphere: Sphere
    before: Floats
    after: Floats
    gain: Floats
    whole: bool


def converted(
    source: Sphere, layout: LayoutSpec, size: tuple[int, int], report: Report = silent
) -> Conversion:
    """Bring light to another layout at (width, height); where that holds no direction it is 0.

    Each texel is the mean over its solid angle, read as finely as the source is. Where both layouts
    hold all directions the sum over the sphere is made equal in the end, which undoes what
    reading between texels lost.
    """
    rows, columns = source.pixels.shape[:2]
    before = source.measured()
    if layout == source.layout and (columns, rows) == size:
        return Conversion(source, before.power, before.power, np.ones(3), before.whole)
    pixels = _averaged(Reader(source), layout, size, _fineness(rows * columns, size), report)
    after = Sphere(pixels.astype(np.float32), layout).measured()
    whole = before.whole and after.whole
    gain = _gain(before.mean, after.mean) if whole else np.ones(3)
    made = Sphere((pixels * gain).astype(np.float32), layout)
    return Conversion(made, before.power, after.power * gain, gain, whole)


def cube_of(source: Sphere, side: int) -> NDArray[np.float32]:
    """Return light as the six faces (6, side, side, 3) of a cube in OpenGL's order.

    Their energy is that of the source where that holds all directions.
    """
    rows, columns = source.pixels.shape[:2]
    fine = _fineness(rows * columns, (6 * side, side))
    read = Reader(source).read(face_directions(side * fine).reshape(-1, 3))
    weights = face_solid_angles(side * fine)[..., np.newaxis]
    shape = (6, side, fine, side, fine, -1)
    summed = (read.reshape(6, side * fine, side * fine, 3) * weights).reshape(shape)
    total = weights.reshape(1, *shape[1:]).sum(axis=(2, 4))
    faces = summed.sum(axis=(2, 4)) / total
    before = source.measured()
    if before.whole:
        total = np.einsum("fstc,st->c", faces, face_solid_angles(side))
        faces *= _gain(before.mean, total / (4 * math.pi))
    light: NDArray[np.float32] = faces.astype(np.float32)
    return light


def _gain(before: Floats, after: Floats) -> Floats:
    return np.divide(before, after, out=np.ones(3), where=(before > 0) & (after > 0))


def _fineness(texels: int, size: tuple[int, int]) -> int:
    """Return how many readings along each side of a new texel see every texel of the source."""
    width, height = size
    there = texels / (width * height)
    return 1 if there <= 1 else min(_FINEST, math.ceil(2 * math.sqrt(there)))


def _averaged(
    reader: Reader, layout: LayoutSpec, size: tuple[int, int], fine: int, report: Report
) -> Floats:
    width, height = size
    weights = layouts.solid_angles(layout, width * fine, height * fine)
    pixels = np.zeros((height, width, 3))
    step = max(1, PLACES // (width * fine * fine))
    for row in range(0, height, step):
        report(row / height, "convert")
        last = min(row + step, height)
        u = (np.arange(width * fine) + 0.5) / (width * fine)
        v = 1 - (np.arange(row * fine, last * fine) + 0.5) / (height * fine)
        places = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
        towards, valid = layouts.direction(layout, places)
        shape = (last - row, fine, width, fine)
        solid = weights[row * fine : last * fine].reshape(shape)
        weight = (solid.ravel() * valid)[:, np.newaxis]
        # A texel of which no reading is on the disc is one of its rim, and read near by.
        missed = (weight.reshape(shape).sum(axis=(1, 3)) == 0)[:, np.newaxis, :, np.newaxis]
        weight += (missed & (solid > 0)).reshape(-1, 1)
        light = (reader.read(towards) * weight).reshape(*shape, 3).sum(axis=(1, 3))
        total = weight.reshape(shape).sum(axis=(1, 3))[..., np.newaxis]
        np.divide(light, total, out=pixels[row:last], where=total > 0)
    return pixels
