"""Parts of a picture made anew out of the rest of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.errors import RenderError
from worker.synthesis.by_example.optimisation import optimise
from worker.synthesis.by_example.task import Task

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.stages import Report

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]


def unmoved(shape: tuple[int, int]) -> Integers:
    """Return the coordinate map of a picture that is where it was, (height, width, 2)."""
    return np.moveaxis(np.indices(shape, np.int32), 0, -1).copy()


def filled(features: Bytes, usable: Mask, place: Integers, seed: int, report: Report) -> Integers:
    """Return a coordinate map with its gaps filled.

    Args:
        features: Of the picture, (height, width, channels).
        usable: Which of its pixels may be copied into gaps, (height, width).
        place: Row and column of the source of each pixel, (height, width, 2); -1 in gaps.
        seed: Of everything random.
        report: Told how far it is.

    Raises:
        RenderError: There are gaps and nothing to copy.
    """
    gaps = place[..., 0] < 0
    if not gaps.any():
        return place
    if not usable.any():
        raise RenderError("nothing is left of the picture to copy", code="exemplar_unusable")
    rows, columns = np.moveaxis(place, -1, 0)
    task = Task(
        source=features, usable=usable, size=gaps.shape, tileable=False, seed=seed, variety=0.0
    ).keeping(features[rows, columns], ~gaps)
    return np.where(gaps[..., np.newaxis], optimise(task, report), place)
