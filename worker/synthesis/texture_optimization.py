"""New texture of which every patch looks like one of the exemplar's (Kwatra et al., 2005)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.perlin import PerlinSpec
from api_schemas.textures.texture_optimization import TextureOptimizationSpec
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.features import edge_distance, weighed
from worker.synthesis.by_example.optimisation import optimise
from worker.synthesis.by_example.result import finished, gathered, nearest
from worker.synthesis.by_example.task import Task
from worker.synthesis.by_example.wishes import Wishes

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.outcome import Outcome
    from worker.preview import Progress

    Bytes = NDArray[np.uint8]
    Integers = NDArray[np.int32]


def synthesize(
    spec: TextureOptimizationSpec,
    size: tuple[int, int],
    inputs: Mapping[str, Image],
    report: Progress,
) -> Outcome:
    """Grow `spec.size` pixels and bring them to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    width, height = spec.size
    wishes = Wishes.of(spec, exemplar, inputs)
    task = Task(
        source=_compared(exemplar.features, spec.outlines, wishes.share),
        usable=exemplar.usable,
        size=(height, width),
        tileable=spec.tileable,
        seed=spec.seed,
        guides=wishes.guides,
        variety=spec.variety,
        longest_copy=0.5,
        smallest=exemplar.smallest,
    )
    if wishes.keep is not None:
        kept = _compared(exemplar.matching(wishes.keep), spec.outlines, wishes.share)
        task = task.keeping(kept, wishes.fixed)

    def show(share: float, place: Integers) -> None:
        kept = wishes.keep
        if kept is not None:
            kept = Image(nearest(kept.pixels, (place.shape[1], place.shape[0])), kept.meaning)
        report(share, "so far", gathered(place, exemplar.image, kept))

    return finished(optimise(task, report, show), exemplar, inputs, size, wishes.keep)


def warm() -> None:
    """Compile the kernels."""
    rows, columns = np.indices((12, 12), np.float32) / np.float32(12)
    picture = Image(np.stack([rows, columns, rows * columns], axis=-1), "colour")
    spec = TextureOptimizationSpec(
        technique="texture_optimization", exemplar=PerlinSpec(technique="perlin"), size=[12, 12]
    )
    synthesize(spec, (12, 12), {"exemplar": picture}, silent)


def _compared(features: Bytes, outlines: float, share: float) -> Bytes:
    """Return colours, and distances from edges if they count, each with its weight."""
    if outlines > 0:
        features = np.concatenate([features, weighed(edge_distance(features), outlines)], axis=-1)
    return weighed(features, share)
