"""Readings of pictures: what each surface parameter that is mapped needs, each once."""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import TABLE_FILTERS, Filter, Map, TextureTransform
from api_schemas.relief import AnyMap, ParallaxMap
from worker.images.pyramids import Cut
from worker.images.relief import Preparation
from worker.images.stored_form import BOX, StoredForm
from worker.rendering.calls import call_of
from worker.rendering.samplers import Sampling
from worker.rendering.shading_layout import LookupLayout
from worker.rendering.textures import Texture


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
        form: StoredForm = BOX,
    ) -> Texture:
        """Return the texture of a spec, with its mip levels if asked for, or as a table.

        With a cut, the levels have as many holes as the texture. With a preparation, it holds what
        that asks for.
        """


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
        self.pictures: list[Picture] = []

    def add(
        self,
        mapped: AnyMap,
        meaning: Meaning,
        cut: Cut | None = None,
        preparation: Preparation | None = None,
    ) -> int:
        """Return the number of a map's lookup, which may be that of an earlier map."""
        picture = self._picture(mapped, meaning, cut, preparation)
        where = (mapped.coordinates, mapped.layout, mapped.transform)
        key = json.dumps([picture, mapped.filter, *(part and part.model_dump() for part in where)])
        if key not in self._found:
            self._found[key] = len(self._lookups)
            calls = [call_of("coordinates", "coordinates", mapped.coordinates)]
            if mapped.layout is not None:
                calls.append(call_of("layout", "layouts", mapped.layout))
            layout = LookupLayout(tuple(calls), mapped.filter, picture)
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
        pictures = [self.pictures[lookup.layout.picture] for lookup in self._lookups]
        periods = [picture.sampling.period for picture in pictures]
        found: dict[str, Any] = {
            "lookup_transform": np.array(
                [
                    texture_from_uv(lookup.mapped.transform, period[:2])
                    for lookup, period in zip(self._lookups, periods, strict=True)
                ]
            ),
            "lookup_period": np.array(periods),
            "lookup_size": np.array([(p.texture.width, p.texture.height) for p in pictures]),
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
        # The walk through a relief reads its levels itself, from no table.
        walked = isinstance(mapped, ParallaxMap) and mapped.filter in TABLE_FILTERS
        filter_name: Filter = "trilinear" if walked else mapped.filter
        sampling = Sampling.of((u, v), filter_name)
        border = tuple(mapped.border_color) if "border" in (u, v) else (0.0,) * 4
        form = StoredForm.of(filter_name, mapped.pyramid, (u, v), border)
        texture = self._texture_of(
            mapped.texture,
            meaning,
            levels=sampling.levels,
            cut=cut,
            preparation=preparation,
            form=form,
        )
        picture = Picture(texture, sampling, border)
        if picture not in self.pictures:
            self.pictures.append(picture)
        return self.pictures.index(picture)


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
