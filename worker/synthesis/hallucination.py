"""A picture enlarged, with detail that an exemplar has (after Sun, Zhu and Tappen, 2010).

Texture optimisation grows the enlarged picture out of the exemplar, guided by what both look like
when they are made small and enlarged again. Then what the result, made small, still lacks is given
back to it (Irani and Peleg, 1991).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis._channels import matched
from worker.synthesis._resample import resample
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.features import FeatureSpace, with_channels
from worker.synthesis.by_example.optimisation import optimise
from worker.synthesis.by_example.result import finished, gathered
from worker.synthesis.by_example.task import Task

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.hallucination import HallucinationSpec
    from worker.stages import Report

    Pixels = NDArray[np.float32]

_ROUNDS = 32
_MOST = np.float32(1e30)


def synthesize(
    spec: HallucinationSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Enlarge `inputs["target"]`, and bring it to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar, target = Exemplar.of(inputs), inputs["target"]
    height, width = exemplar.shape
    small = (max(1, width // spec.factor), max(1, height // spec.factor))
    large = (target.width * spec.factor, target.height * spec.factor)
    blurred = resample(resample(exemplar.image.pixels, small), (width, height))
    enlarged = Image(resample(target.pixels, large), target.meaning)
    space = FeatureSpace.of(exemplar.image)
    ours = space.encode(Image(blurred, exemplar.image.meaning))
    task = Task(
        source=exemplar.features,
        usable=exemplar.usable,
        size=(large[1], large[0]),
        tileable=False,
        seed=spec.seed,
        guides=(ours, with_channels(space.encode(enlarged), ours.shape[2])),
        variety=0.0,
    )
    place = optimise(task, report)
    made = finished(place, exemplar, inputs, size)
    if "picture" in inputs:  # which has no small version to agree with
        return made
    projected, residual = back_projected(*matched(gathered(place, exemplar.image), target))
    return Outcome(
        Image(resample(projected, size), target.meaning),
        made.layers,
        {**made.report, "residual": residual},
    )


def back_projected(large: Pixels, small: Pixels) -> tuple[Pixels, float]:
    """Change a large picture until, made small, it is a given one; return the largest rest."""
    size = (small.shape[1], small.shape[0])
    large, small = _workable(large), _workable(small)
    residual = np.inf
    for _ in range(_ROUNDS):
        rest = small - resample(large, size)
        residual = float(np.abs(rest).max())
        if residual < 1 / 1024:
            break
        large = large + resample(rest, (large.shape[1], large.shape[0]))
    return large, residual


def _workable(pixels: Pixels) -> Pixels:
    """Return numbers that can be added up: what is none is 0, what is endless is only huge."""
    return np.clip(np.nan_to_num(pixels), -_MOST, _MOST)
