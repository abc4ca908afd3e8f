"""Colours along a line, picked by the first channel of another texture (Perlin, 1985)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.numba_kernel import parallel_kernel, prange

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.ramp import RampSpec
    from worker.closed_form import Parameter
    from worker.stages import Report

_INTERPOLATIONS = {"linear": 0, "smooth": 1, "step": 2}


def synthesize(
    spec: RampSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Colour the scalar picture `inputs["input"]`.

    Stops count by position; of several at one position the one written last begins there and the
    one written first ends there. NaN takes the first colour.
    """
    return Image(colored(spec, np.array(inputs["input"].pixels[..., 0])), spec.meaning)


def colored(spec: RampSpec, scalars: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the colours (height, width, 3) of scalars (height, width)."""
    positions, colors = _stops(spec)
    pixels = np.empty((*scalars.shape, 3), np.float32)
    _fill_ramp(pixels, scalars, positions, colors, _INTERPOLATIONS[spec.interpolation])
    return pixels


def closed_form(spec: RampSpec, *, solid: bool) -> Mapping[str, Parameter]:
    """Return the stops; the value they are picked by is the input."""
    positions, colors = _stops(spec)
    return {
        "count": len(positions),
        "interpolation": _INTERPOLATIONS[spec.interpolation],
        "positions": positions.astype(np.float32),
        "colors": colors.astype(np.float32),
    }


def warm() -> None:
    """Compile the kernel."""
    pixels = np.empty((1, 1, 3), np.float32)
    _fill_ramp(pixels, np.zeros((1, 1), np.float32), np.zeros(1), np.zeros((1, 3)), 0)


def _stops(spec: RampSpec) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return rising positions (n,) and colours (n, 3)."""
    stops = sorted(spec.stops, key=lambda stop: stop.position)
    positions = np.array([stop.position for stop in stops])
    return positions, np.array([stop.color for stop in stops], np.float64)


@parallel_kernel
def _fill_ramp(
    pixels: NDArray[np.float32],
    scalars: NDArray[np.float32],
    positions: NDArray[np.float64],
    colors: NDArray[np.float64],
    interpolation: int,
) -> None:
    height, width, channels = pixels.shape
    for row in prange(height):
        for column in range(width):
            value = np.float64(scalars[row, column])
            upper = 0
            while upper < len(positions) and positions[upper] <= value:
                upper += 1
            lower = max(upper - 1, 0)
            share = 0.0
            if interpolation != 2 and 0 < upper < len(positions):
                share = (value - positions[lower]) / (positions[upper] - positions[lower])
                if interpolation == 1:
                    share = share * share * (3.0 - 2.0 * share)
            else:
                upper = lower
            for channel in range(channels):
                low = colors[lower, channel]
                pixels[row, column, channel] = low * (1.0 - share) + colors[upper, channel] * share
