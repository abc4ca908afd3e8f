"""Squares of two colours as a sum of waves (Hughes et al., 2013, exercise 20.3).

The square wave is S(x) = 4/pi (sin pi x + sin(3 pi x) / 3 + sin(5 pi x) / 5 + ...). A pixel that is
w squares wide holds waves of up to 1 / (2 w) swings per square: harmonics k < 1 / w.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, get_args

import numpy as np

from api_schemas.textures.band_limited_checkerboard import FINEST_LIMIT
from worker.images.image import Image
from worker.synthesis._two_colors import blended

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from api_schemas.textures.band_limited_checkerboard import BandLimitedCheckerboardSpec
    from worker.closed_form import Parameter
    from worker.stages import Report

_GAUSSIAN = 4.5
"""The limit is three standard deviations from the middle."""


def synthesize(
    spec: BandLimitedCheckerboardSpec,
    size: tuple[int, int],
    inputs: Mapping[str, Image],
    report: Report,
) -> Image:
    """Evaluate the tile in the middle of each pixel of (width, height)."""
    across, down = (
        _waves(spec, (np.arange(pixels) + 0.5) * cells / pixels, cells / pixels)
        for pixels, cells in zip(size, spec.cells, strict=True)
    )
    return Image(blended(spec.colors, across, down[::-1]), spec.meaning)


def color_at(
    spec: BandLimitedCheckerboardSpec, places: NDArray[np.float64], reach: Sequence[float]
) -> NDArray[np.float64]:
    """Return colours (n, 3) at points.

    Args:
        spec: The squares.
        places: (n, 2), in tiles.
        reach: Width and height of a pixel, in tiles.
    """
    across, down = (
        _waves(spec, (place - np.floor(place)) * cells, length * cells)
        for place, cells, length in zip(places.T, spec.cells, reach, strict=True)
    )
    share = (0.5 + 0.5 * across * down)[:, np.newaxis]
    first, second = np.array(spec.colors, np.float32).astype(np.float64)
    colors: NDArray[np.float64] = share * first + (1 - share) * second
    return colors


def closed_form(
    spec: BandLimitedCheckerboardSpec, *, solid: bool
) -> Mapping[str, Parameter] | None:
    """Return cells, colours, the limit, 0 for that of a pixel, and which window; none in space."""
    if solid:
        return None
    first, second = np.array(spec.colors, np.float32)
    windows = get_args(type(spec).model_fields["window"].annotation)
    return {
        "cells": np.array(spec.cells, np.float32),
        "first": first,
        "second": second,
        "band_limit": spec.band_limit or 0.0,
        "window": windows.index(spec.window),
    }


def _waves(
    spec: BandLimitedCheckerboardSpec, x: NDArray[np.float64], width: float
) -> NDArray[np.float64]:
    """Return S at places in squares, of what a pixel so many squares wide can hold."""
    limit = spec.band_limit or min(1 / width if width else math.inf, FINEST_LIMIT)
    total = np.zeros_like(x)
    for k in range(1, math.ceil(limit), 2):
        total += _weight(spec.window, k / limit) / k * np.sin(np.pi * ((k * x) % 2))
    return 4 / np.pi * total


def _weight(window: str, share: float) -> float:
    """Return how much of a wave is kept, 0..1 of the limit."""
    match window:
        case "truncated":
            return 1.0
        case "fejer":
            return 1 - share
        case "lanczos":
            return float(np.sinc(share))
    return math.exp(-_GAUSSIAN * share**2)
