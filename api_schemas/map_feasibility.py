"""Maps that are well-formed and still cannot be looked up."""

from collections.abc import Iterator

from api_schemas.coordinates.triplanar import TriplanarSpec
from api_schemas.families import TextureSpec
from api_schemas.layouts.cube import CubeSpec
from api_schemas.maps import ColorMap, Map, NumberMap, TextureTransform
from api_schemas.obstacle import Obstacle
from api_schemas.relief import BumpMap, HeightMap, ParallaxMap, ReliefMap
from api_schemas.surface_spec import SurfaceSpec
from api_schemas.walk import parts

FORMULAS_MAX = 24
"""Textures worked out on one surface: their numbers fill a shader's uniforms."""


def formula_obstacles(surface: SurfaceSpec, pointer: str) -> Iterator[Obstacle]:
    """Yield that a surface has too many formulas, if it has."""
    maps = [part for _, part in parts(surface) if isinstance(part, ColorMap | NumberMap)]
    formulas = sum(
        isinstance(part, TextureSpec)
        for mapped in maps
        if mapped.filter == "formula"
        for _, part in parts(mapped.texture)
    )
    if formulas > FORMULAS_MAX:
        yield Obstacle(
            "too_many_maps", pointer, f"{formulas} formulas on one surface; at most {FORMULAS_MAX}"
        )


def map_obstacles(mapped: Map, pointer: str) -> Iterator[Obstacle]:
    """Yield what stands in the way of a map that is at a JSON pointer."""
    if mapped.layout is not None:
        yield from _layout(mapped, pointer)
    if mapped.filter == "formula":
        yield from _formula(mapped, pointer)
    if isinstance(mapped, ReliefMap | BumpMap):
        yield from _relief(mapped, pointer)


def _layout(mapped: Map, pointer: str) -> Iterator[Obstacle]:
    layout = mapped.layout
    assert layout is not None
    if mapped.coordinates.dimensions != 3:
        yield Obstacle(
            "layout_without_direction",
            f"{pointer}/layout",
            f"{mapped.coordinates.technique} coordinates are a place on the picture already; "
            "a layout needs a direction",
        )
    if isinstance(layout, CubeSpec):
        if mapped.transform != TextureTransform():
            yield Obstacle(
                "layout_impossible",
                f"{pointer}/transform",
                "the faces of a cube cannot be shifted, turned or repeated",
            )
        if mapped.filter == "formula":
            yield Obstacle(
                "formula_missing", f"{pointer}/filter", "a cube's faces are cut from a picture"
            )


def _formula(mapped: Map, pointer: str) -> Iterator[Obstacle]:
    if not isinstance(mapped, ColorMap | NumberMap) or (
        isinstance(mapped, NumberMap) and mapped.channel == "packed"
    ):
        yield Obstacle(
            "formula_missing", f"{pointer}/filter", "what is looked up here needs a picture"
        )
        return
    for place, part in parts(mapped.texture, f"{pointer}/texture"):
        if isinstance(part, TextureSpec) and not part.has_formula():
            yield Obstacle(
                "formula_missing", place, f"this {part.technique} has no formula to work out"
            )


def _relief(mapped: ReliefMap | BumpMap, pointer: str) -> Iterator[Obstacle]:
    one_place = isinstance(mapped, HeightMap | ParallaxMap)
    if one_place and isinstance(mapped.coordinates, TriplanarSpec):
        message = "a relief is read at one place, not at three"
        yield Obstacle("coordinates_unsuited", f"{pointer}/coordinates", message)
    if isinstance(mapped.layout, CubeSpec):
        message = "a relief has no slopes over the edges of a cube"
        yield Obstacle("layout_impossible", f"{pointer}/layout", message)
