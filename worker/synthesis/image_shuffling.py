"""A picture of which a part has been moved (after Simakov et al., 2008)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.filling import filled, unmoved
from worker.synthesis.by_example.result import finished

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.image_shuffling import ImageShufflingSpec
    from worker.images.image import Image
    from worker.outcome import Outcome
    from worker.preview import Progress

    Mask = NDArray[np.bool_]


def synthesize(
    spec: ImageShufflingSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Move the region, fill around it, and bring the picture to (width, height).

    What is moved is not copied to where it was, or it would come back.

    Raises:
        RenderError: The region leaves nothing to copy.
    """
    exemplar = Exemplar.of(inputs)
    region = inputs["region"].pixels[..., 0] >= 0.5
    right, down = spec.shift
    place = unmoved(exemplar.shape)
    if right == down == 0 or not region.any():
        return finished(place, exemplar, inputs, size)
    moved = place - np.array([down, right], np.int32)
    inside: Mask = np.all((moved >= 0) & (moved < exemplar.shape), axis=-1)
    rows, columns = np.moveaxis(np.where(inside[..., np.newaxis], moved, 0), -1, 0)
    arrived = inside & region[rows, columns]
    place[_grown(region, spec.margin) | _grown(arrived, spec.margin)] = -1
    place[arrived] = moved[arrived]
    place = filled(exemplar, exemplar.usable & ~region, place, spec.seed, report)
    return finished(place, exemplar, inputs, size)


def _grown(mask: Mask, by: int) -> Mask:
    return np.asarray(ndimage.maximum_filter(mask, 2 * by + 1, mode="constant"))
