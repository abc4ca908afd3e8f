"""Where in an exemplar each patch of a picture is found again (Barnes et al., 2009)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.field_search import exact_field, quick_field
from worker.synthesis.by_example.patch_match import NEVER, Field
from worker.synthesis.by_example.result import finished, nearest
from worker.synthesis.by_example.several_nearest import (
    SeveralField,
    several_exactly,
    several_quickly,
)
from worker.synthesis.by_example.windows import fitting_side

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.nearest_neighbour_field import NearestNeighbourFieldSpec
    from worker.stages import Report

    Bytes = NDArray[np.uint8]


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
    fields, energies = _search(spec, exemplar, target, side, report)
    beside: dict[str, NDArray[np.generic]] = {}
    for rank, field in enumerate(fields):
        name = f"_{rank + 1}" if rank else ""
        offsets = _over_pixels(_offsets(field), target.shape[:2], side).astype(np.int64)
        distances = np.sqrt(field.costs / (side * side * target.shape[2])) / 255
        distances = np.where(field.costs < NEVER, distances, 1.0)[..., np.newaxis]
        beside[f"offset{name}"] = offsets[..., ::-1]
        beside[f"distance{name}"] = _over_pixels(distances, target.shape[:2], side)
    offsets = beside["offset"][..., ::-1].astype(np.int64)
    place = (np.moveaxis(np.indices(target.shape[:2]), 0, -1) + offsets).astype(np.int32)
    made = finished(place, exemplar, inputs, size)
    return Outcome(
        made.image,
        {**made.layers, **{name: _layer(values, size) for name, values in beside.items()}},
        {**made.report, "patch": side, "energies": [round(energy, 3) for energy in energies]},
    )


def warm() -> None:
    """Compile the kernels of several places."""
    features = np.arange(75, dtype=np.uint8).reshape(5, 5, 3)
    passes = several_quickly(features, features, np.ones((5, 5), bool), 3, 0, 2)
    next(passes)
    next(passes)


def _search(
    spec: NearestNeighbourFieldSpec, exemplar: Exemplar, target: Bytes, side: int, report: Report
) -> tuple[list[Field], list[float]]:
    """Return the field of the nearest patches, of the second nearest, and so on; and energies."""
    source, usable, several = exemplar.features, exemplar.usable, spec.nearest > 1
    if spec.method == "exact":
        if several:
            exact = several_exactly(target, source, usable, side, spec.nearest, report)
            return _each(exact), [_energy(exact)]
        field = exact_field(target, source, usable, side, report)
        return [field], [_energy(field)]
    passes: Iterator[Field | SeveralField] = (
        several_quickly(target, source, usable, side, spec.seed, spec.nearest)
        if several
        else quick_field(target, source, usable, side, spec.seed)
    )
    energies = []
    for done in range(spec.iterations + 1):
        found = next(passes)
        energies.append(_energy(found))
        report((done + 1) / (spec.iterations + 1), f"pass {done} of {spec.iterations}")
    return ([found] if isinstance(found, Field) else _each(found)), energies


def _each(field: SeveralField) -> list[Field]:
    """Return the fields of all ranks; where there is none of a rank, its place is the nearest."""
    found = []
    for rank in range(field.costs.shape[2]):
        costs = field.costs[..., rank]
        rows, columns = (np.where(costs < NEVER, p[..., rank], p[..., 0]) for p in field[:2])
        found.append(Field(rows, columns, costs))
    return found


def _energy(field: Field | SeveralField) -> float:
    """Return the mean cost of what was found."""
    return float(field.costs[field.costs < NEVER].mean())


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
