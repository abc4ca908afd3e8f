"""From a surface of the language to what its program needs: a layout, uniforms and textures.

The layout decides the program; numbers, transforms and channels are uniforms and do not.
"""

import functools
import json
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol, cast, get_args

import numpy as np

from api_schemas.coordinates.uv import UvSpec
from api_schemas.families import Meaning, SurfaceSpec, TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.maps import ColorMap, Map, NormalMap, NumberMap, TextureTransform
from worker.errors import RenderError
from worker.images.pyramids import Cut
from worker.images.stored_form import BOX, StoredForm
from worker.rendering.chunks import chunk
from worker.rendering.samplers import Sampling
from worker.rendering.shading_layout import (
    LookupLayout,
    Parameter,
    PictureLayout,
    ShadingLayout,
)
from worker.rendering.textures import Texture

_STRUCT = re.compile(r"^struct Surface \{(?P<fields>.*?)^\};", re.MULTILINE | re.DOTALL)
_FIELD = re.compile(r"^ +(?P<type>float|vec3|int) (?P<name>\w+);", re.MULTILINE)
_TABLE = re.compile(r"^uniform sampler2D table_(?P<texture>\w+);", re.MULTILINE)
_TABLE_SAMPLING = Sampling(wrap=("clamp", "clamp"), smooth=True, levels=False)
_MEANINGS: dict[str, Meaning] = {"vec3": "colour", "float": "data"}


class TextureSource(Protocol):
    """Where uploaded textures come from."""

    def __call__(
        self,
        spec: TextureSpec,
        meaning: Meaning,
        *,
        levels: bool,
        cut: Cut | None = None,
        form: StoredForm = BOX,
    ) -> Texture:
        """Return the texture of a spec, with its mip levels if asked for, or as a table.

        With a cut, the levels have as many holes as the texture.
        """


@dataclass(frozen=True, slots=True)
class Picture:
    """A texture bound to a unit, with the value beyond its border."""

    texture: Texture
    sampling: Sampling
    border: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Shading:
    """A surface ready to draw; `double_sided` says whether its inner side is drawn too."""

    layout: ShadingLayout
    uniforms: dict[str, Any]
    pictures: tuple[Picture, ...]
    double_sided: bool


@functools.cache
def surface_fields(technique: str) -> dict[str, str]:
    """Return name and GLSL type of each field in the technique's struct Surface.

    Raises:
        RenderError: The technique has no chunk, or its chunk no such struct.
    """
    try:
        struct = _STRUCT.search(chunk(f"surfaces/{technique}.glsl"))
    except FileNotFoundError:
        struct = None
    if struct is None:
        raise RenderError(f"surface technique {technique} has no chunk with a struct Surface")
    return {field["name"]: field["type"] for field in _FIELD.finditer(struct["fields"])}


def shade(surface: SurfaceSpec, texture_of: TextureSource) -> Shading:
    """Lay out a surface's parameters: plain values as uniforms, maps as lookups in pictures."""
    plan = _Plan(texture_of)
    surface = surface.filled()
    parameters = tuple(
        plan.parameter(surface, name, kind)
        for name, kind in surface_fields(surface.technique).items()
    )
    opacity = plan.opacity(surface)
    normal = None if surface.normal is None else plan.normal(surface.normal)
    tables = surface_tables(surface.technique)
    pictures = (*plan.pictures, *(_table(spec, texture_of) for spec in tables.values()))
    layout = ShadingLayout(
        technique=surface.technique,
        parameters=parameters,
        alpha_mode=surface.alpha_mode,
        opacity=opacity,
        normal=normal,
        lookups=tuple(lookup.layout for lookup in plan.lookups),
        pictures=tuple(
            PictureLayout(picture.sampling, picture.texture.format) for picture in pictures
        ),
        tables=tuple(tables),
    )
    return Shading(layout, plan.all_uniforms(), pictures, surface.double_sided)


@functools.cache
def surface_tables(technique: str) -> dict[str, TextureSpec]:
    """Return the textures that a surface's chunk reads by itself, by the names of their samplers.

    `uniform sampler2D table_dfg` is the texture technique dfg, smooth and clamped, its outermost
    texels at 0 and 1.
    """
    textures = FAMILIES["textures"]
    return {
        f"table_{name}": cast(
            "TextureSpec", textures[name].model_validate({"technique": name, "span": "edges"})
        )
        for name in _TABLE.findall(chunk(f"surfaces/{technique}.glsl"))
    }


def _table(spec: TextureSpec, texture_of: TextureSource) -> Picture:
    return Picture(texture_of(spec, "data", levels=False), _TABLE_SAMPLING, (0.0,) * 4)


def tangent_uv_set(surface: SurfaceSpec) -> int | None:
    """Return which of a mesh's uv sets its tangents follow, if the surface needs tangents."""
    if surface.normal is None:
        return None
    coordinates = surface.normal.coordinates
    return coordinates.set if isinstance(coordinates, UvSpec) else 0


@dataclass(frozen=True, slots=True)
class _Lookup:
    layout: LookupLayout
    transform: TextureTransform


class _Plan:
    """Collects lookups and pictures, each once."""

    def __init__(self, texture_of: TextureSource) -> None:
        self._texture_of = texture_of
        self._uniforms: dict[str, Any] = {}
        self._found: dict[str, int] = {}
        self.lookups: list[_Lookup] = []
        self.pictures: list[Picture] = []

    def parameter(
        self, surface: SurfaceSpec, name: str, kind: str, cut: Cut | None = None
    ) -> Parameter:
        value = getattr(surface, name)
        if not isinstance(value, ColorMap | NumberMap):
            self._uniforms[name + "_value"] = _plain(surface, name, kind, value)
            return Parameter(name, kind, None)
        self._uniforms[name + "_bias"] = value.bias
        if isinstance(value, NumberMap):
            self._uniforms[name + "_scale"] = value.scale
            self._uniforms[name + "_channel"] = "rgba".index(value.channel)
        else:
            self._uniforms[name + "_scale"] = value.scale * np.array(value.tint)
        return Parameter(name, kind, self._lookup(value, _MEANINGS[kind], cut))

    def opacity(self, surface: SurfaceSpec) -> Parameter | None:
        """Lay out the opacity, unless it is ignored."""
        if surface.alpha_mode == "opaque":
            return None
        cut = None
        if surface.alpha_mode == "mask":
            self._uniforms["alpha_cutoff"] = surface.alpha_cutoff
            if isinstance(mapped := surface.opacity, NumberMap):
                channel = "rgba".index(mapped.channel)
                cut = Cut(channel, mapped.scale, mapped.bias, surface.alpha_cutoff)
        return self.parameter(surface, "opacity", "float", cut)

    def normal(self, mapped: NormalMap) -> int:
        """Lay out a normal map; return its lookup."""
        self._uniforms["normal_range"] = (2.0, -1.0) if mapped.range == "unit" else (1.0, 0.0)
        self._uniforms["normal_axes"] = _normal_axes(mapped).ravel()
        return self._lookup(mapped, "data")

    def _lookup(
        self,
        mapped: ColorMap | NumberMap | NormalMap,
        meaning: Meaning,
        cut: Cut | None = None,
    ) -> int:
        picture = self._picture(mapped, mapped.texture, meaning, cut)
        technique, *choices = mapped.coordinates.model_dump().values()
        layout = LookupLayout(technique, tuple(choices), mapped.filter, picture)
        key = json.dumps(
            [picture, mapped.filter, mapped.coordinates.model_dump(), mapped.transform.model_dump()]
        )
        if key not in self._found:
            self._found[key] = len(self.lookups)
            self.lookups.append(_Lookup(layout, mapped.transform))
        return self._found[key]

    def _picture(self, mapped: Map, spec: TextureSpec, meaning: Meaning, cut: Cut | None) -> int:
        u, v = mapped.wrap
        sampling = Sampling.of((u, v), mapped.filter)
        border = tuple(mapped.border_color) if "border" in (u, v) else (0.0,) * 4
        form = StoredForm.of(mapped.filter, mapped.pyramid, (u, v), border)
        texture = self._texture_of(spec, meaning, levels=sampling.levels, cut=cut, form=form)
        picture = Picture(texture, sampling, border)
        if picture not in self.pictures:
            self.pictures.append(picture)
        return self.pictures.index(picture)

    def all_uniforms(self) -> dict[str, Any]:
        """Return the parameters' uniforms and the lookups' arrays."""
        if not self.lookups:
            return self._uniforms
        pictures = [self.pictures[lookup.layout.picture] for lookup in self.lookups]
        periods = [picture.sampling.period for picture in pictures]
        return self._uniforms | {
            "lookup_transform": np.array(
                [
                    texture_from_uv(lookup.transform, period[:2])
                    for lookup, period in zip(self.lookups, periods, strict=True)
                ]
            ),
            "lookup_period": np.array(periods),
            "lookup_size": np.array([(p.texture.width, p.texture.height) for p in pictures]),
        }


def texture_from_uv(transform: TextureTransform, period: Sequence[float]) -> np.ndarray:
    """Give the 3 x 3 matrix that scales, then turns, then shifts texture coordinates.

    The shift is brought into the wrap's period here, in float64, where whole tiles cost no bits.
    """
    matrix = np.eye(3)
    matrix[:2, :2] = _turn(transform) * np.array(transform.scale)
    matrix[:2, 2] = [
        shift - length * math.floor(shift / length) if length else shift
        for shift, length in zip(transform.offset, period, strict=True)
    ]
    return matrix


def _normal_axes(mapped: NormalMap) -> np.ndarray:
    """Give the 2 x 2 matrix that takes a normal map's x and y to where u and v grow.

    A picture that is turned or mirrored on the surface has its own x and y turned or mirrored.
    """
    mirrored = np.where(np.array(mapped.transform.scale) < 0, -1.0, 1.0)
    green = 1.0 if mapped.green == "up" else -1.0
    picture_from_uv = _turn(mapped.transform) * mirrored
    return picture_from_uv.T * (mapped.strength * np.array([1.0, green]))


def _turn(transform: TextureTransform) -> np.ndarray:
    cosine, sine = math.cos(transform.rotation), math.sin(transform.rotation)
    return np.array([[cosine, -sine], [sine, cosine]])


def _plain(surface: SurfaceSpec, name: str, kind: str, value: Any) -> Any:
    """Numbers and colours are themselves; a choice among words is its place in the Literal."""
    if kind != "int" or isinstance(value, int):
        return value
    return get_args(type(surface).model_fields[name].annotation).index(value)
