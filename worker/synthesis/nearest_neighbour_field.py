"""Where in an exemplar each patch of a picture is found again (Barnes et al., 2009)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.field_search import exact_field, quick_field
from worker.synthesis.by_example.result import finished, nearest
from worker.synthesis.by_example.windows import fitting_side

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.nearest_neighbour_field import NearestNeighbourFieldSpec
    from worker.stages import Report
    from worker.synthesis.by_example.patch_match import Field


def synthesize(
    spec: NearestNeighbourFieldSpec,
    size: tuple[int, int],
    inputs: Mapping[str, Image],
    report: Report,
) -> Outcome:
    """Find the field for the target, and bring what it gathers to (width, height).

    Pixels nearer to the border than half a patch belong to the patch at the border.

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    target = exemplar.matching(inputs["target"])
    side = fitting_side(exemplar.usable, target.shape[:2], spec.patch)
    energies: list[float] = []
    if spec.method == "exact":
        field = exact_field(target, exemplar.features, exemplar.usable, side, report)
        energies = [float(field.costs.mean())]
    else:
        passes = quick_field(target, exemplar.features, exemplar.usable, side, spec.seed)
        for done in range(spec.iterations + 1):
            field = next(passes)
            energies.append(float(field.costs.mean()))
            report((done + 1) / (spec.iterations + 1), f"pass {done} of {spec.iterations}")
    offsets = _over_pixels(_offsets(field), target.shape[:2], side).astype(np.int64)
    distances = np.sqrt(field.costs / (side * side * target.shape[2])) / 255
    distances = _over_pixels(distances[..., np.newaxis], target.shape[:2], side)
    place = (np.moveaxis(np.indices(target.shape[:2]), 0, -1) + offsets).astype(np.int32)
    made = finished(place, exemplar, inputs, size)
    beside = {"offset": offsets[..., ::-1], "distance": distances}
    return Outcome(
        made.image,
        {**made.layers, **{name: _layer(values, size) for name, values in beside.items()}},
        {**made.report, "patch": side, "energies": [round(energy, 3) for energy in energies]},
    )


def _offsets(field: Field) -> NDArray[np.int64]:
    """Return how many rows and columns away each patch is found, (rows, columns, 2)."""
    here = np.indices(field.rows.shape)
    return np.stack([field.rows - here[0], field.columns - here[1]], axis=-1)


def _over_pixels(
    values: NDArray[np.generic], shape: tuple[int, ...], side: int
) -> NDArray[np.generic]:
    """Give the middle pixels of patches their values, and the border those of its nearest."""
    before = side // 2
    margins = [
        (before, length - count - before)
        for length, count in zip(shape, values.shape[:2], strict=True)
    ]
    return np.pad(values, [*margins, (0, 0)], mode="edge")


def _layer(values: NDArray[np.generic], size: tuple[int, int]) -> Image:
    return Image(nearest(values.astype(np.float32), size), "data")
