"""Year rings (Peachey, 1985): the part of a ring that a point lies outwards, 0..1.

The sawtooth is averaged over a pixel as if rings were straight there and nothing disturbed them.
Over a width below one ring there is at most one edge, from 1 to 0; at a ring and more 1/2 is left.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.volume import Volume
from worker.numba_kernel import kernel, parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.wood import WoodSpec
    from worker.closed_form import Parameter
    from worker.stages import Report

    Numbers = NDArray[np.float64]


def synthesize(
    spec: WoodSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Disturb rings by `inputs["noise"]`: one channel of data."""
    width, height = size
    values = np.array(inputs["noise"].pixels[np.newaxis, ..., 0])
    u, v, w = _ways(spec, [_centres(width), _rising(height), np.zeros(1)])
    _fill_rings(values, u, v, w, *_form(spec))
    return Image(values[0, ..., np.newaxis], spec.meaning)


def synthesize_volume(
    spec: WoodSpec, size: tuple[int, int, int], inputs: Mapping[str, Volume], report: Report
) -> Volume:
    """Disturb rings in space by `inputs["noise"]`: one channel of data."""
    width, height, depth = size
    values = np.array(inputs["noise"].voxels[..., 0])
    u, v, w = _ways(spec, [_centres(width), _rising(height), _centres(depth)])
    _fill_rings(values, u, v, w, *_form(spec))
    return Volume(values[..., np.newaxis], spec.meaning)


def wood_at(spec: WoodSpec, places: Numbers, noise: Numbers, reach: float) -> Numbers:
    """Return values (n,) at places (n, 3) in tiles with given noise (n,), over a reach in tiles."""
    values = noise.copy()
    u, v, w = _ways(spec, list(places.T))
    _fill_rings_at(values, u, v, w, *_form(spec), spec.rings * reach)
    return values


def closed_form(spec: WoodSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return heart and trunk; the noise is the input."""
    across, heart = _across(spec)
    return {
        "across": across.astype(np.float32),
        "heart": heart.astype(np.float32),
        "rings": spec.rings,
        "strength": spec.strength,
        "rest": spec.rest,
    }


def warm() -> None:
    """Compile the kernel."""
    place = np.zeros(1)
    _fill_rings(np.zeros((1, 1, 1), np.float32), place, place, place, 1.0, 0.0, 0.0)


def _form(spec: WoodSpec) -> tuple[float, float, float]:
    return spec.rings, spec.strength, spec.rest


def _across(spec: WoodSpec) -> tuple[Numbers, Numbers]:
    """Return which of the three axes lie across the trunk, as 0 or 1, and the heart on them."""
    across = np.array([axis != spec.trunk for axis in "uvw"], np.float64)
    heart = np.zeros(3)
    heart[across > 0] = spec.heart
    return across, heart


def _ways(spec: WoodSpec, places: list[Numbers]) -> list[Numbers]:
    """Return how far places along each axis are from the heart, 0 along the trunk."""
    across, heart = _across(spec)
    return [np.array((x - h) * a) for x, h, a in zip(places, heart, across, strict=True)]


def _centres(count: int) -> Numbers:
    return (np.arange(count) + 0.5) / count


def _rising(count: int) -> Numbers:
    return _centres(count)[::-1]


@parallel_kernel
def _fill_rings(
    values: NDArray[np.float32],
    u: Numbers,
    v: Numbers,
    w: Numbers,
    rings: float,
    strength: float,
    rest: float,
) -> None:
    """Replace noise (depth, height, width) by rings."""
    depth, height, width = values.shape
    pixels = min(width, height, depth) if depth > 1 else min(width, height)
    reach = rings / pixels
    for line in prange(depth * height):
        away, up = w[line // height], v[line % height]
        row = values[line // height, line % height]
        for column in range(width):
            radius = np.sqrt(u[column] * u[column] + up * up + away * away)
            row[column] = _ring(rings * radius + strength * (row[column] - rest), reach)


@kernel
def _fill_rings_at(
    values: Numbers,
    u: Numbers,
    v: Numbers,
    w: Numbers,
    rings: float,
    strength: float,
    rest: float,
    reach: float,
) -> None:
    for n in range(len(values)):
        radius = np.sqrt(u[n] * u[n] + v[n] * v[n] + w[n] * w[n])
        values[n] = _ring(rings * radius + strength * (values[n] - rest), reach)


@kernel
def _ring(x: float, reach: float) -> float:
    """Return the mean of the part of x beyond a whole number, over a width around x."""
    part: float = x - np.floor(x)
    half = min(reach, 1.0) / 2
    over = max(half - part, part + half - 1.0, 0.0)
    # Of the width, `over` lies beyond the edge; the sawtooth is 1 lower above it, higher below
    if over == 0:
        return part
    share = over / (2 * half)
    return part + share if part < half else part - share
