"""Parts of a picture made anew out of the rest of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from worker.errors import RenderError
from worker.images.image import Image
from worker.synthesis.by_example.optimisation import optimise
from worker.synthesis.by_example.result import gathered
from worker.synthesis.by_example.task import Task

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.preview import Progress
    from worker.synthesis.by_example.exemplar import Exemplar

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]


def unmoved(shape: tuple[int, int]) -> Integers:
    """Return the coordinate map of a picture that is where it was, (height, width, 2)."""
    return np.moveaxis(np.indices(shape, np.int32), 0, -1).copy()


def filled(
    exemplar: Exemplar, usable: Mask, place: Integers, seed: int, report: Progress
) -> Integers:
    """Return a coordinate map with its gaps filled.

    Args:
        exemplar: The picture.
        usable: Which of its pixels may be copied into gaps, (height, width).
        place: Row and column of the source of each pixel, (height, width, 2); -1 in gaps.
        seed: Of everything random.
        report: Told how far it is, and shown what there is.

    Raises:
        RenderError: There are gaps and nothing to copy.
    """
    gaps = place[..., 0] < 0
    if not gaps.any():
        return place
    if not usable.any():
        raise RenderError("nothing is left of the picture to copy", code="exemplar_unusable")
    features = exemplar.features
    rows, columns = np.moveaxis(place, -1, 0)
    task = Task(
        source=features, usable=usable, size=gaps.shape, tileable=False, seed=seed, variety=0.0
    ).keeping(features[rows, columns], ~gaps)
    around = gathered(place, exemplar.image)

    def show(share: float, found: Integers) -> None:
        there = found[tuple(_nearest_made(found[..., 0] >= 0, gaps))]
        pixels = around.pixels.copy()
        pixels[gaps] = exemplar.image.pixels[there[:, 0], there[:, 1]]
        report(share, "so far", Image(pixels, around.meaning))

    return np.where(gaps[..., np.newaxis], optimise(task, report, show), place)


def _nearest_made(made: Mask, gaps: Mask) -> NDArray[np.intp]:
    """Return, for each pixel of the gaps, row and column of the nearest that has been made.

    That may be in a smaller picture, whose gaps are smaller by parts of a pixel.
    """
    within = ndimage.distance_transform_edt(~made, return_distances=False, return_indices=True)
    places = zip(np.nonzero(gaps), made.shape, gaps.shape, strict=True)
    rows, columns = (at * small // large for at, small, large in places)
    return np.asarray(within[:, rows, columns], np.intp)
