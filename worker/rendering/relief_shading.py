"""From the maps that tilt, raise or deepen a surface to a layout and uniforms."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from api_schemas.coordinates.uv import UvSpec
from api_schemas.layouts.cube import CubeSpec
from api_schemas.maps import Map, NormalMap
from api_schemas.relief import AnyMap, BumpMap, HeightMap, ParallaxMap, TangentFrames
from api_schemas.solid import is_carved
from api_schemas.surface_spec import SurfaceSpec
from worker.images.relief import Decoded, Flat, Normals, Preparation, Slopes
from worker.rendering.lookups import turn
from worker.rendering.shading_layout import ReliefLayout

LookUp: TypeAlias = Callable[[AnyMap, Preparation | None], int]
"""Lays a lookup of data out, of a picture that is made ready first, and returns its number."""


@dataclass(frozen=True, slots=True)
class TangentsWanted:
    """Which tangents a surface needs on its mesh: of which uv set, and how they are found."""

    uv_set: int
    frames: TangentFrames


def tangents_wanted(surface: SurfaceSpec) -> TangentsWanted | None:
    """Return what tangents the maps of a surface tilt along, if any does."""
    normal = surface.normal if surface.normal and surface.normal.space == "tangent" else None
    leading = normal or surface.bump
    if leading is None:
        return TangentsWanted(0, surface.tangents) if surface.needs_tangents else None
    coordinates = leading.coordinates
    uv_set = coordinates.set if isinstance(coordinates, UvSpec) else 0
    return TangentsWanted(uv_set, surface.tangents)


def lay_out(surface: SurfaceSpec, look_up: LookUp) -> tuple[ReliefLayout, dict[str, Any]]:
    """Return what the compiler must know of a surface's relief, and its uniforms."""
    uniforms: dict[str, Any] = {}
    normal, bump, height, parallax = None, None, None, None
    by_normal = by_bump = False
    if surface.normal is not None:
        by_normal = _roughens(surface.normal)
        prepared = Normals(surface.normal.range) if by_normal else None
        uniforms |= _normal(surface.normal)
        normal = look_up(surface.normal, prepared)
        if by_normal:
            uniforms |= {"normal_range": (1.0, 0.0), "normal_steeper": surface.normal.strength}
    if surface.bump is not None:
        by_bump = _roughens(surface.bump)
        uniforms |= _bump(surface.bump)
        bump = look_up(surface.bump, Decoded(surface.bump.encoding, squares=by_bump))
        if by_bump:
            uniforms["bump_steeper"] = surface.bump.range
    if surface.height is not None:
        uniforms |= _height(surface.height)
        layout = surface.height.layout
        u, v = surface.height.wrap if layout is None else layout.joins
        channel = "rgba".index(surface.height.channel)
        height = look_up(surface.height, Slopes(channel, (u, v)))
    if surface.parallax is not None:
        uniforms |= _parallax(surface.parallax)
        parallax = look_up(surface.parallax, Flat())
    relief = ReliefLayout(
        normal=normal,
        normal_space=surface.normal.space if surface.normal else "tangent",
        bump=bump,
        roughened_by_normal=by_normal,
        roughened_by_bump=by_bump,
        height=height,
        parallax=parallax,
        parallax_method=surface.parallax.method if surface.parallax else "offset",
    )
    return relief, uniforms


def _roughens(mapped: NormalMap | BumpMap) -> bool:
    """Tell whether what is finer than a pixel is told by means of a picture, where there is one."""
    pictured = mapped.filter != "formula" and not isinstance(mapped.layout, CubeSpec)
    return mapped.fine_detail == "roughness" and pictured and not is_carved(mapped)


def _normal(mapped: NormalMap) -> dict[str, Any]:
    green = np.array([1.0, 1.0 if mapped.green == "up" else -1.0])
    found: dict[str, Any] = {"normal_range": (2.0, -1.0) if mapped.range == "unit" else (1.0, 0.0)}
    if mapped.space == "object":
        return found | {
            "normal_axes": np.diag(green).ravel(),
            "normal_strength": mapped.strength,
        }
    axes = _uv_from_picture(mapped) * (mapped.strength * green)
    return found | {"normal_axes": axes.ravel()}


def _bump(mapped: BumpMap) -> dict[str, Any]:
    return {"bump_axes": (_uv_from_picture(mapped) * mapped.range).ravel()}


def _height(mapped: HeightMap) -> dict[str, Any]:
    return {
        "height_depth": mapped.depth,
        "height_middle": mapped.middle,
        "height_exact": mapped.method == "exact",
    }


def _parallax(mapped: ParallaxMap) -> dict[str, Any]:
    found: dict[str, Any] = {
        "parallax_depth": mapped.depth,
        "parallax_channel": "rgba".index(mapped.channel),
        "parallax_steps": mapped.steps,
    }
    return found


def _uv_from_picture(mapped: Map) -> np.ndarray:
    """Give the 2 x 2 matrix that takes a picture's x and y to where u and v grow.

    A picture that is turned or mirrored on the surface has its own x and y turned or mirrored.
    """
    mirrored = np.where(np.array(mapped.transform.scale) < 0, -1.0, 1.0)
    return np.array((turn(mapped.transform) * mirrored).T)
