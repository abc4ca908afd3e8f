"""Readings of pictures: what each surface parameter that is mapped needs, each once."""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from api_schemas.families import LayoutSpec, Meaning, TextureSpec
from api_schemas.layouts.cube import CubeSpec
from api_schemas.maps import TABLE_FILTERS, Filter, Map, TextureTransform
from api_schemas.relief import AnyMap, ParallaxMap
from api_schemas.solid import is_carved
from worker.errors import RenderError
from worker.images.pyramids import Cut
from worker.images.relief import Preparation
from worker.images.stored_form import BOX, StoredForm
from worker.rendering.calls import call_of
from worker.rendering.closed_forms import Formula
from worker.rendering.samplers import Sampling
from worker.rendering.shading_layout import SPACE_FILTERS, FormulaLayout, LookupLayout
from worker.rendering.textures import Texture

_UNITS = (1.0, 1.0, 1.0, 1.0)
"""Periods of what repeats with every tile, and their inverses."""


class TextureSource(Protocol):
    """Where uploaded textures come from."""

    def __call__(
        self,
        spec: TextureSpec,
        meaning: Meaning,
        *,
        levels: bool,
        cut: Cut | None = None,
        preparation: Preparation | None = None,
        layout: LayoutSpec | None = None,
        form: StoredForm = BOX,
    ) -> Texture:
        """Return the texture of a spec, with its mip levels if asked for, or as a table.

        With a cut, the levels have as many holes as the texture. With a preparation, it holds what
        that asks for. With a layout, what that holds is drawn out over the rest.
        """

    def volume(self, spec: TextureSpec, meaning: Meaning, *, levels: bool) -> Texture:
        """Return the texture of a spec that fills space."""

    def cube(
        self, spec: TextureSpec, meaning: Meaning, layout: CubeSpec, *, levels: bool
    ) -> Texture:
        """Return the six faces that lie so on the picture of a spec."""

    def formula(
        self, spec: TextureSpec, meaning: Meaning, name: str, *, solid: bool
    ) -> Formula | None:
        """Return a spec as a formula, if there is one; the names of uniforms begin with `name`."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A texture bound to a unit, with the value beyond its border."""

    texture: Texture
    sampling: Sampling
    border: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class _Lookup:
    layout: LookupLayout
    mapped: Map


class Lookups:
    """Collects lookups and pictures, each once.

    Attributes:
        pictures: In the order of their units.
    """

    def __init__(self, texture_of: TextureSource) -> None:
        """Begin with none; textures are taken from `texture_of`."""
        self._texture_of = texture_of
        self._found: dict[str, int] = {}
        self._lookups: list[_Lookup] = []
        self._values: dict[str, Any] = {}
        self.pictures: list[Picture] = []

    def add(
        self,
        mapped: AnyMap,
        meaning: Meaning,
        cut: Cut | None = None,
        preparation: Preparation | None = None,
    ) -> int:
        """Return the number of a map's lookup, which may be that of an earlier map."""
        formula = mapped.filter == "formula"
        picture = None if formula else self._picture(mapped, meaning, cut, preparation)
        read = [mapped.texture.model_dump(), meaning] if formula else picture
        where = (mapped.coordinates, mapped.layout, mapped.transform)
        key = json.dumps([read, mapped.filter, *(part and part.model_dump() for part in where)])
        if key not in self._found:
            number = self._found[key] = len(self._lookups)
            calls = [call_of("coordinates", "coordinates", mapped.coordinates)]
            if mapped.layout is not None and calls[0].returns != "Reach":
                raise RenderError(
                    f"{mapped.coordinates.technique} coordinates are no direction",
                    code="layout_without_direction",
                )
            if mapped.layout is not None:
                calls.append(call_of("layout", "layouts", mapped.layout))
            found = self._formula(mapped, meaning, number) if formula else None
            layout = LookupLayout(tuple(calls), mapped.filter, picture, found)
            self._lookups.append(_Lookup(layout, mapped))
        return self._found[key]

    @property
    def layouts(self) -> tuple[LookupLayout, ...]:
        """What the compiler must know of each."""
        return tuple(lookup.layout for lookup in self._lookups)

    def uniforms(self) -> dict[str, Any]:
        """Return what else the program asks for."""
        if not self._lookups:
            return {}
        periods, sizes = [], []
        for lookup in self._lookups:
            at = lookup.layout.picture
            picture = None if at is None else self.pictures[at]
            periods.append(_UNITS if picture is None else picture.sampling.period)
            sizes.append((picture.texture.width, picture.texture.height) if picture else (1, 1))
        found: dict[str, Any] = self._values | {
            "lookup_transform": np.array(
                [
                    texture_from_uv(lookup.mapped.transform, period[:2])
                    for lookup, period in zip(self._lookups, periods, strict=True)
                ]
            ),
            "lookup_period": np.array(periods),
            "lookup_size": np.array(sizes),
        }
        for number, lookup in enumerate(self._lookups):
            specs = (lookup.mapped.coordinates, lookup.mapped.layout)
            for call, spec in zip(lookup.layout.calls, specs, strict=False):
                assert spec is not None
                found |= call.values(spec, number)
        return found

    def _picture(
        self, mapped: AnyMap, meaning: Meaning, cut: Cut | None, preparation: Preparation | None
    ) -> int:
        u, v = mapped.wrap if mapped.layout is None else mapped.layout.joins
        carved = preparation is None and is_carved(mapped)
        in_space = carved or isinstance(mapped.layout, CubeSpec)
        filter_name = _stored_for(mapped, in_space)
        sampling = Sampling.of((u, v), filter_name)
        border = tuple(mapped.border_color) if "border" in (u, v) else (0.0,) * 4
        read = (mapped.texture, meaning)
        if isinstance(mapped.layout, CubeSpec):
            texture = self._texture_of.cube(*read, mapped.layout, levels=sampling.levels)
        elif in_space:
            texture = self._texture_of.volume(*read, levels=sampling.levels)
        else:
            form = StoredForm.of(filter_name, mapped.pyramid, (u, v), border)
            texture = self._texture_of(
                *read,
                levels=sampling.levels,
                cut=cut,
                preparation=preparation,
                layout=mapped.layout,
                form=form,
            )
        picture = Picture(texture, sampling, border)
        if picture not in self.pictures:
            self.pictures.append(picture)
        return self.pictures.index(picture)

    def _formula(self, mapped: AnyMap, meaning: Meaning, number: int) -> FormulaLayout:
        solid = is_carved(mapped)
        name = f"formula_{number}"
        found = self._texture_of.formula(mapped.texture, meaning, name, solid=solid)
        if found is None:
            raise RenderError(
                f"{mapped.texture.technique} has no formula, so it cannot be filtered by it",
                code="formula_missing",
            )
        self._values |= found.uniforms
        return FormulaLayout(found.chunks, found.declarations, found.call, solid)


def _stored_for(mapped: AnyMap, in_space: bool) -> Filter:
    """Return the filter by which a texture is stored: some readings know few."""
    if in_space and mapped.filter not in SPACE_FILTERS:
        return "anisotropic"
    if isinstance(mapped, ParallaxMap) and mapped.filter in TABLE_FILTERS:
        return "trilinear"  # the walk through a relief reads levels itself
    return mapped.filter


def texture_from_uv(transform: TextureTransform, period: Sequence[float]) -> np.ndarray:
    """Give the 3 x 3 matrix that scales, then turns, then shifts texture coordinates.

    The shift is brought into the wrap's period here, in float64, where whole tiles cost no bits.
    """
    matrix = np.eye(3)
    matrix[:2, :2] = turn(transform) * np.array(transform.scale)
    matrix[:2, 2] = [
        shift - length * math.floor(shift / length) if length else shift
        for shift, length in zip(transform.offset, period, strict=True)
    ]
    return matrix


def turn(transform: TextureTransform) -> np.ndarray:
    """Give the 2 x 2 matrix of a transform's rotation."""
    cosine, sine = math.cos(transform.rotation), math.sin(transform.rotation)
    return np.array([[cosine, -sine], [sine, cosine]])
