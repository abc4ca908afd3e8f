"""A picture brought to another size without squeezing it (Simakov et al., 2008).

By texture optimisation in steps: each size begins with what was found at the one before, squeezed
or stretched a little, and its patches then become again what they are in the exemplar. The price of
patches used often has what was lost come back: the other direction of bidirectional similarity.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.features import edge_distance
from worker.synthesis.by_example.filling import unmoved
from worker.synthesis.by_example.optimisation import optimise
from worker.synthesis.by_example.result import finished, gathered
from worker.synthesis.by_example.task import Task

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.retargeting import RetargetingSpec
    from worker.images.image import Image
    from worker.outcome import Outcome
    from worker.preview import Progress
    from worker.synthesis.by_example.arrays import Integers


def synthesize(
    spec: RetargetingSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Make `spec.size` pixels and bring them to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    width, height = spec.size
    if (height, width) == exemplar.shape and exemplar.usable.all():
        return finished(unmoved(exemplar.shape), exemplar, inputs, size)
    place = unmoved(exemplar.shape)
    steps = spec.sizes(exemplar.shape)
    for done, step in enumerate(steps):

        def tell(share: float, name: str, done: int = done) -> None:
            report((done + share) / len(steps), f"step {done + 1} of {len(steps)}: {name}")

        place = optimise(_task(spec, exemplar, place, step), tell)
        if done + 1 < len(steps):
            report((done + 1) / len(steps), "so far", gathered(place, exemplar.image))
    return finished(place, exemplar, inputs, size)


def _task(
    spec: RetargetingSpec, exemplar: Exemplar, place: Integers, size: tuple[int, int]
) -> Task:
    """Ask for a size, beginning with what was found at the one before."""
    return Task(
        source=np.concatenate([exemplar.features, edge_distance(exemplar.features)], axis=-1),
        usable=exemplar.usable,
        size=size,
        tileable=False,
        seed=spec.seed,
        variety=spec.completeness,
        start=place,
    )
