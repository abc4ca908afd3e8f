"""Products of sums of waves (Gardner, 1985), in a plane or in space.

The sums are divided by what they can reach, so that values lie within 0..1. In space there is a
third factor along w, whose waves are shifted by those along u as those along v are; Gardner shifted
waves along u by their place along w instead, which would not repeat along w. A wave too fine for
the pixels fades by the sinc of its swings in a pixel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.images.volume import Volume
from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._counter_hash import uniforms

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.gardner_product import GardnerProductSpec
    from worker.stages import Report

    Numbers = NDArray[np.float64]


def synthesize(
    spec: GardnerProductSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Evaluate the product at the pixel centres of (width, height): one channel of data."""
    return Image(_slices(spec, size)[0], spec.meaning)


def synthesize_volume(
    spec: GardnerProductSpec,
    size: tuple[int, int, int],
    inputs: Mapping[str, Volume],
    report: Report,
) -> Volume:
    """Evaluate the product at the voxel centres of (width, height, depth)."""
    return Volume(_slices(spec, size), spec.meaning)


def warm() -> None:
    """Compile the kernel."""
    number = np.ones(1)
    _fill_products(
        np.empty((1, 1, 1), np.float32), (number, number, number), False, number, number, 0.5
    )


def _slices(spec: GardnerProductSpec, size: tuple[int, ...]) -> NDArray[np.float32]:
    """Return (depth, height, width, 1); two sizes are those of the only slice."""
    centres = [(np.arange(count) + 0.5) / count for count in size]
    centres[1] = centres[1][::-1].copy()
    flat = len(size) == 2
    swings = 2.0 ** np.arange(spec.count) * spec.frequency
    gains = spec.gain ** np.arange(spec.count)
    strengths = np.array(np.sinc(swings / min(size)) * gains / gains.sum(), np.float64)
    values = np.empty((1 if flat else size[2], size[1], size[0]), np.float32)
    _fill_products(
        values,
        (centres[0], centres[1], np.zeros(1) if flat else centres[2]),
        flat,
        2 * np.pi * np.concatenate([swings, uniforms(spec.seed, 0, 3)]),
        strengths,
        spec.contrast,
    )
    return values[..., np.newaxis]


@parallel_kernel
def _fill_products(
    values: NDArray[np.float32],
    places: tuple[Numbers, Numbers, Numbers],
    flat: bool,
    angles: Numbers,
    strengths: Numbers,
    contrast: float,
) -> None:
    """Write (depth, height, width); after the frequencies, `angles` has three first phases."""
    depth, height, width = values.shape
    count = len(strengths)
    for line in prange(depth * height):
        v, w = places[1][line % height], places[2][line // height]
        for column in range(width):
            u = places[0][column]
            product = _factor(u, v, angles, angles[count], strengths, contrast)
            product *= _factor(v, u, angles, angles[count + 1], strengths, contrast)
            if not flat:
                product *= _factor(w, u, angles, angles[count + 2], strengths, contrast)
            values[line // height, line % height, column] = product


@kernel
def _factor(
    place: float,
    other: float,
    angles: Numbers,
    phase: float,
    strengths: Numbers,
    contrast: float,
) -> float:
    """Return a sum of waves along an axis, shifted by those of another one, within 0..1."""
    total = 0.0
    for i in range(len(strengths)):
        total += strengths[i] * np.sin(angles[i] * place + phase)
        phase = np.pi / 2 * np.sin(angles[i] * other)
    return (1 + contrast * total) / (1 + contrast)
