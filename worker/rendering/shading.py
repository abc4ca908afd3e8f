"""From a surface of the language to what its program needs: a layout, uniforms and textures.

The layout decides the program; numbers, transforms and channels are uniforms and do not.
"""

import functools
import re
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from api_schemas.families import Meaning, TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.maps import ColorMap, NumberMap
from api_schemas.relief import AnyMap
from api_schemas.surface_maps import SurfaceMap
from api_schemas.surface_spec import SurfaceSpec
from worker.errors import RenderError
from worker.images.pyramids import Cut
from worker.images.relief import Preparation, Unpacked
from worker.rendering import relief_shading
from worker.rendering.calls import choice
from worker.rendering.chunks import chunk, join
from worker.rendering.lookups import Lookups, Picture, TextureSource
from worker.rendering.samplers import Sampling
from worker.rendering.shading_layout import Parameter, PictureLayout, ReliefLayout, ShadingLayout

_STRUCT = re.compile(r"^struct Surface \{(?P<fields>.*?)^\};", re.MULTILINE | re.DOTALL)
_FIELD = re.compile(r"^ +(?P<type>float|vec3|int) (?P<name>\w+);", re.MULTILINE)
_TABLE = re.compile(r"^uniform sampler2D table_(?P<texture>\w+);", re.MULTILINE)
_TABLE_SAMPLING = Sampling(wrap=("clamp", "clamp"), smooth=True, levels=False)
_MEANINGS: dict[str, Meaning] = {"vec3": "colour", "float": "data"}


@dataclass(frozen=True, slots=True)
class Shading:
    """A surface ready to draw; `double_sided` says whether its inner side is drawn too."""

    layout: ShadingLayout
    uniforms: dict[str, Any]
    pictures: tuple[Picture, ...]
    double_sided: bool


@dataclass(frozen=True, slots=True)
class Selection:
    """Which of the surfaces of a map is drawn."""

    among: SurfaceMap
    number: int


def is_lit(technique: str) -> bool:
    """Tell whether a surface asks for the lights: others need no program for their shadows."""
    return "lib/lights.glsl" in _chunks_of(technique)


def has_lobe(technique: str) -> bool:
    """Tell whether a surface leaves the shape of its highlights to a chunk of its program."""
    return "lib/lobe.glsl" in _chunks_of(technique)


@functools.cache
def _chunks_of(technique: str) -> tuple[str, ...]:
    name = f"surfaces/{technique}.glsl"
    return join(chunk(name), name).chunks


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


def shade(
    surface: SurfaceSpec, texture_of: TextureSource, selection: Selection | None = None
) -> Shading:
    """Lay out a surface's parameters: plain values as uniforms, maps as lookups in pictures.

    With a selection it is drawn only where that says.
    """
    plan = _Plan(texture_of)
    surface = surface.filled()
    parameters = tuple(
        plan.parameter(surface, name, kind)
        for name, kind in surface_fields(surface.technique).items()
    )
    opacity = plan.opacity(surface)
    relief = plan.relief(surface)
    light_map = selected = None
    if surface.light_map is not None and is_lit(surface.technique):
        light_map = plan.parameter(surface, "light_map", "vec3")
    if selection is not None:
        selected = plan.selection(selection)
    tables = surface_tables(surface.technique)
    pictures = (*plan.lookups.pictures, *(_table(spec, texture_of) for spec in tables.values()))
    layout = ShadingLayout(
        technique=surface.technique,
        parameters=parameters,
        alpha_mode=surface.alpha_mode,
        opacity=opacity,
        relief=relief,
        light_map=light_map,
        selection=selected,
        lookups=plan.lookups.layouts,
        pictures=tuple(
            PictureLayout(picture.sampling, picture.texture.format) for picture in pictures
        ),
        tables=tuple(tables),
        streaked=surface.is_streaked,
    )
    uniforms = plan.uniforms | plan.lookups.uniforms()
    return Shading(layout, uniforms, pictures, surface.double_sided)


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


class _Plan:
    """Lays out parameters one after another: their uniforms, and the lookups of those mapped."""

    def __init__(self, texture_of: TextureSource) -> None:
        self.uniforms: dict[str, Any] = {}
        self.lookups = Lookups(texture_of)

    def parameter(
        self, surface: SurfaceSpec, name: str, kind: str, cut: Cut | None = None
    ) -> Parameter:
        value = getattr(surface, name)
        if isinstance(value, ColorMap | NumberMap):
            return self.mapped(value, name, kind, cut)
        self.uniforms[name + "_value"] = _plain(surface, name, kind, value)
        return Parameter(name, kind, None)

    def mapped(
        self, value: ColorMap | NumberMap, name: str, kind: str, cut: Cut | None = None
    ) -> Parameter:
        self.uniforms[name + "_bias"] = value.bias
        if isinstance(value, NumberMap):
            self.uniforms[name + "_scale"] = value.scale
            self.uniforms[name + "_channel"] = _channel(value)
        else:
            self.uniforms[name + "_scale"] = value.scale * np.array(value.tint)
        packed = isinstance(value, NumberMap) and value.channel == "packed"
        preparation = Unpacked() if packed else None
        return Parameter(name, kind, self.lookups.add(value, _MEANINGS[kind], cut, preparation))

    def selection(self, selection: Selection) -> Parameter:
        """Lay out the map that says where the surface is."""
        self.uniforms["selected"] = selection.number
        self.uniforms["selected_last"] = len(selection.among.surfaces) - 1
        return self.mapped(selection.among, "selection", "float")

    def opacity(self, surface: SurfaceSpec) -> Parameter | None:
        """Lay out the opacity, unless it is ignored."""
        if surface.alpha_mode == "opaque":
            return None
        cut = None
        if surface.alpha_mode == "mask":
            self.uniforms["alpha_cutoff"] = surface.alpha_cutoff
            if isinstance(mapped := surface.opacity, NumberMap):
                cut = Cut(_channel(mapped), mapped.scale, mapped.bias, surface.alpha_cutoff)
        return self.parameter(surface, "opacity", "float", cut)

    def relief(self, surface: SurfaceSpec) -> ReliefLayout:
        """Lay out what tilts, raises or deepens the surface."""

        def look_up(mapped: AnyMap, preparation: Preparation | None) -> int:
            return self.lookups.add(mapped, "data", preparation=preparation)

        layout, uniforms = relief_shading.lay_out(surface, look_up)
        self.uniforms |= uniforms
        return layout


def _channel(mapped: NumberMap) -> int:
    return 0 if mapped.channel == "packed" else "rgba".index(mapped.channel)


def _plain(surface: SurfaceSpec, name: str, kind: str, value: Any) -> Any:
    """Numbers and colours are themselves; a choice among words is its place among them."""
    return choice(surface, name) if kind == "int" else value
