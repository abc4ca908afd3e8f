"""Noise that looks like an exemplar, made by blending pieces of it (Heitz and Neyret, 2018).

The result is cut into triangles, whose corners are the middles of pieces from random places of the
exemplar. Plain blends of three would be grey; so the exemplar's values are first replaced by those
of a Gaussian of the same ranks, blended so that the variance stays, and looked up again: the
histogram of the result is that of the exemplar. Colours are turned onto their principal axes for
it, which depend on each other least.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.special import ndtr, ndtri

from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._resample import resample
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.triangles import corners
from worker.synthesis.by_example.windows import fitting_side, whole_windows

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.by_example_noise import ByExampleNoiseSpec
    from worker.stages import Report

    Numbers = NDArray[np.float64]
    Indices = NDArray[np.int64]


class Gaussian(NamedTuple):
    """A picture whose channels are Gaussian, and the way back.

    Attributes:
        values: Of mean 0 and variance 1, (height, width, channels).
        ordered: The values of the picture from low to high along each of its axes, (pixels,
            channels).
        axes: The principal axes of its colours, in columns.
        middle: Its mean colour.
    """

    values: Numbers
    ordered: Numbers
    axes: Numbers
    middle: Numbers


def synthesize(
    spec: ByExampleNoiseSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Blend `spec.size` pixels and bring them to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    width, height = spec.size
    side = fitting_side(exemplar.usable, exemplar.shape, 2 * spec.piece)
    middles = np.argwhere(whole_windows(exemplar.usable, (side, side))) + side // 2
    places, weights = _pieces((height, width), max(1, side // 2), middles, spec.seed)
    report(0.3, "blending")
    picture = inputs.get("picture", exemplar.image)
    straight = np.nan_to_num(picture.pixels, posinf=3e38, neginf=-3e38)
    gaussian = to_gaussian(straight.astype(np.float64))
    limits = np.array(exemplar.shape) - 1
    blended = blend(
        np.stack([gaussian.values[tuple(np.minimum(p, limits).T)] for p in places]), weights
    )
    report(0.7, "giving back the histogram")
    pixels = from_gaussian(blended, gaussian).reshape(height, width, -1)
    low, high = straight.min(axis=(0, 1)), straight.max(axis=(0, 1))
    image = np.clip(pixels.astype(np.float32), low, high)
    return Outcome(Image(resample(image, size), picture.meaning))


def to_gaussian(pixels: Numbers) -> Gaussian:
    """Replace the values along each principal axis by those of a Gaussian of the same ranks."""
    height, width, channels = pixels.shape
    colours = pixels.reshape(-1, channels)
    middle = colours.mean(axis=0)
    axes = np.linalg.eigh(np.atleast_2d(np.cov(colours.T, bias=True)))[1]
    along = (colours - middle) @ axes
    order = np.argsort(along, axis=0, kind="stable")
    ranks = np.empty_like(order)
    count = len(along)
    np.put_along_axis(ranks, order, np.arange(count)[:, np.newaxis], axis=0)
    values = ndtri((ranks + 0.5) / count).reshape(height, width, channels)
    return Gaussian(values, np.take_along_axis(along, order, axis=0), axes, middle)


def blend(values: Numbers, weights: Numbers) -> Numbers:
    """Blend Gaussian values (pieces, pixels, channels) by weights (pieces, pixels).

    Their mean is 0; that and the variance stay.
    """
    sums = np.einsum("ij,ijk->jk", weights, values)
    return np.asarray(sums / np.sqrt((weights**2).sum(axis=0))[:, np.newaxis])


def from_gaussian(values: Numbers, gaussian: Gaussian) -> Numbers:
    """Return the colours, (pixels, channels), that have the ranks of Gaussian values."""
    count = len(gaussian.ordered)
    ranks = ndtr(values) * count - 0.5
    along = np.stack(
        [
            np.interp(ranks[:, axis], np.arange(count), gaussian.ordered[:, axis])
            for axis in range(values.shape[1])
        ],
        axis=-1,
    )
    return np.asarray(along @ gaussian.axes.T + gaussian.middle)


def _pieces(
    size: tuple[int, int], step: int, middles: Indices, seed: int
) -> tuple[list[Indices], Numbers]:
    """Return for each pixel its place in three pieces, (pixels, 2) each, and their weights."""
    found, count = corners(size, step)
    chances = (uniforms(seed, 0, count) * len(middles)).astype(np.int64)
    places = [
        np.maximum(middles[chances[corner.number]] + np.floor(corner.away).astype(np.int64), 0)
        for corner in found
    ]
    return places, np.stack([corner.weight for corner in found])
