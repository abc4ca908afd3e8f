"""A picture of which a part is made anew out of the rest (Wexler et al., 2007)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.filling import filled, unmoved
from worker.synthesis.by_example.result import finished

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.hole_filling import HoleFillingSpec
    from worker.images.image import Image
    from worker.outcome import Outcome
    from worker.preview import Progress


def synthesize(
    spec: HoleFillingSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Fill the hole, and bring the picture to (width, height).

    Raises:
        RenderError: The hole leaves nothing to copy.
    """
    exemplar = Exemplar.of(inputs)
    hole = inputs["hole"].pixels[..., 0] >= 0.5
    place = unmoved(exemplar.shape)
    place[hole] = -1
    place = filled(exemplar, exemplar.usable & ~hole, place, spec.seed, report)
    return finished(place, exemplar, inputs, size)
