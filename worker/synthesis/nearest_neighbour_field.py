"""Where in an exemplar each patch of a picture is found again (Barnes et al., 2009)."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

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
from worker.synthesis.by_example.turned_match import TurnedField, turned_field
from worker.synthesis.by_example.turned_patches import Pair
from worker.synthesis.by_example.windows import fitting_side

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.nearest_neighbour_field import NearestNeighbourFieldSpec
    from worker.stages import Report

    Bytes = NDArray[np.uint8]
    Layers = dict[str, NDArray[np.int64] | NDArray[np.float64]]

AnyField = TypeVar("AnyField", Field, SeveralField, TurnedField)
Number = TypeVar("Number", bound=np.generic)


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
    find = _turned if spec.turned else _as_they_lie
    found, energies = find(spec, exemplar, target, side, report)
    offsets = np.rint(found["offset"][..., ::-1])
    place = (np.moveaxis(np.indices(target.shape[:2]), 0, -1) + offsets).astype(np.int32)
    made = finished(place, exemplar, inputs, size)
    return Outcome(
        made.image,
        {**made.layers, **{name: _layer(values, size) for name, values in found.items()}},
        {**made.report, "patch": side, "energies": [round(energy, 3) for energy in energies]},
    )


def warm() -> None:
    """Compile the kernels of several places, and of turned patches."""
    features = np.arange(75, dtype=np.uint8).reshape(5, 5, 3)
    pictures = features, features, np.ones((5, 5), bool)
    several = several_quickly(*pictures, 3, 0, 2)
    turned = turned_field(Pair.of(*pictures, 3, 1.0, 2.0), 0)
    for _ in range(2):
        next(several)
        next(turned)


def _as_they_lie(
    spec: NearestNeighbourFieldSpec, exemplar: Exemplar, target: Bytes, side: int, report: Report
) -> tuple[Layers, list[float]]:
    """Return layers of the nearest patches, of the second nearest, and so on; and energies."""
    fields, energies = _search(spec, exemplar, target, side, report)
    layers: Layers = {}
    for rank, field in enumerate(fields):
        name = f"_{rank + 1}" if rank else ""
        distances = _distances(field.costs, side, target.shape[2])
        layers[f"offset{name}"] = _over_pixels(_offsets(field), target.shape[:2], side)[..., ::-1]
        layers[f"distance{name}"] = _over_pixels(distances, target.shape[:2], side)
    return layers, energies


def _turned(
    spec: NearestNeighbourFieldSpec, exemplar: Exemplar, target: Bytes, side: int, report: Report
) -> tuple[Layers, list[float]]:
    """Return layers of the nearest patches, however they lie, and energies."""
    ways = spec.rotations, spec.scales
    pair = Pair.of(target, exemplar.features, exemplar.usable, side, *ways)
    field, energies = _improved(turned_field(pair, spec.seed), spec.iterations, report)
    shape = target.shape[:2]
    over = TurnedField(*(_over_pixels(part, shape, side) for part in field))
    pixels = [np.arange(length, dtype=np.float64) for length in shape]
    middles = [
        np.clip(steps - side // 2, 0, length - side) + (side - 1) / 2
        for steps, length in zip(pixels, shape, strict=True)
    ]
    beside = [steps - middle for steps, middle in zip(pixels, middles, strict=True)]
    places = over.places(beside[0][:, np.newaxis], beside[1])
    places = np.clip(places, 0, np.array(exemplar.shape) - 1)
    return {
        "offset": (places - np.moveaxis(np.indices(shape), 0, -1))[..., ::-1],
        "distance": _distances(over.costs, side, target.shape[2]),
        "angle": over.radians[..., np.newaxis],
        "scale": over.factors[..., np.newaxis],
    }, energies


def _improved(
    passes: Iterator[AnyField], iterations: int, report: Report
) -> tuple[AnyField, list[float]]:
    """Return what some passes make of a field, and its energy before, between and after them."""
    energies = []
    for done in range(iterations + 1):
        found = next(passes)
        energies.append(_energy(found))
        report((done + 1) / (iterations + 1), f"pass {done} of {iterations}")
    return found, energies


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
    if several:
        quick = several_quickly(target, source, usable, side, spec.seed, spec.nearest)
        some, energies = _improved(quick, spec.iterations, report)
        return _each(some), energies
    found, energies = _improved(
        quick_field(target, source, usable, side, spec.seed), spec.iterations, report
    )
    return [found], energies


def _each(field: SeveralField) -> list[Field]:
    """Return the fields of all ranks; where there is none of a rank, its place is the nearest."""
    found = []
    for rank in range(field.costs.shape[2]):
        costs = field.costs[..., rank]
        rows, columns = (np.where(costs < NEVER, p[..., rank], p[..., 0]) for p in field[:2])
        found.append(Field(rows, columns, costs))
    return found


def _energy(field: Field | SeveralField | TurnedField) -> float:
    """Return the mean cost of what was found."""
    return float(field.costs[field.costs < NEVER].mean())


def _offsets(field: Field) -> NDArray[np.int64]:
    """Return how many rows and columns away each patch is found, (rows, columns, 2)."""
    here = np.indices(field.rows.shape)
    return np.stack([field.rows - here[0], field.columns - here[1]], axis=-1)


def _distances(costs: NDArray[np.int32], side: int, channels: int) -> NDArray[np.float64]:
    """Return roots of mean squares, 0..1; 1 where nothing was found, (.., 1)."""
    distances = np.sqrt(costs / (side * side * channels)) / 255
    return np.where(costs < NEVER, distances, 1.0)[..., np.newaxis]


def _over_pixels(values: NDArray[Number], shape: tuple[int, ...], side: int) -> NDArray[Number]:
    """Give the middle pixels of patches their values, and the border those of its nearest."""
    before = side // 2
    margins = [
        (before, length - count - before)
        for length, count in zip(shape, values.shape[:2], strict=True)
    ]
    return np.pad(values, margins + [(0, 0)] * (values.ndim - 2), mode="edge")


def _layer(values: NDArray[np.generic], size: tuple[int, int]) -> Image:
    return Image(nearest(values.astype(np.float32), size), "data")
