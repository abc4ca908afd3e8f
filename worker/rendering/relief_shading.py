"""From the maps that tilt, raise or deepen a surface to a layout and uniforms."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from api_schemas.coordinates.uv import UvSpec
from api_schemas.layouts.cube import CubeSpec
from api_schemas.maps import FineDetail, Map, NormalMap
from api_schemas.relief import AnyMap, BumpMap, HeightMap, ParallaxMap, TangentFrames
from api_schemas.solid import is_carved
from api_schemas.surface_spec import SurfaceSpec
from worker.images.relief import Decoded, Flat, Normals, Preparation, Products, Slopes
from worker.rendering.lookups import turn
from worker.rendering.shading_layout import ReliefLayout, Spread

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
    fine_normals = fine_bumps = "lost"
    spreads = []
    if surface.normal is not None:
        fine_normals = _fine(surface.normal, surface)
        uniforms |= _normal(surface.normal)
        told = Normals(surface.normal.range, slopes=fine_normals == "streaks")
        normal = look_up(surface.normal, None if fine_normals == "lost" else told)
        if fine_normals != "lost":
            uniforms["normal_range"] = (1.0, 0.0)
        if fine_normals == "roughness":
            uniforms["normal_steeper"] = surface.normal.strength
        if fine_normals == "streaks":
            spreads.append(Spread("normal", normal, look_up(surface.normal, Products(told)), True))
    if surface.bump is not None:
        fine_bumps = _fine(surface.bump, surface)
        uniforms |= _bump(surface.bump)
        decoded = Decoded(surface.bump.encoding, squares=fine_bumps == "roughness")
        bump = look_up(surface.bump, decoded)
        if fine_bumps == "roughness":
            uniforms["bump_steeper"] = surface.bump.range
        if fine_bumps == "streaks":
            spreads.append(Spread("bump", bump, look_up(surface.bump, Products(decoded)), True))
    if surface.height is not None:
        uniforms |= _height(surface.height)
        layout = surface.height.layout
        u, v = surface.height.wrap if layout is None else layout.joins
        channel = "rgba".index(surface.height.channel)
        slopes = Slopes(channel, (u, v))
        height = look_up(surface.height, slopes)
        if surface.height.fine_detail != "lost":
            streaks = _fine(surface.height, surface) == "streaks"
            products = look_up(surface.height, Products(slopes))
            spreads.append(Spread("height", height, products, streaks))
    if surface.parallax is not None:
        uniforms |= _parallax(surface.parallax)
        parallax = look_up(surface.parallax, Flat())
    relief = ReliefLayout(
        normal=normal,
        normal_space=surface.normal.space if surface.normal else "tangent",
        bump=bump,
        roughened_by_normal=fine_normals == "roughness",
        roughened_by_bump=fine_bumps == "roughness",
        height=height,
        parallax=parallax,
        parallax_method=surface.parallax.method if surface.parallax else "offset",
        spreads=tuple(spreads),
    )
    return relief, uniforms


def _fine(mapped: NormalMap | BumpMap | HeightMap, surface: SurfaceSpec) -> FineDetail:
    """Tell what becomes of what is finer than a pixel: it is told by means of a picture."""
    carved = not isinstance(mapped, HeightMap) and is_carved(mapped)
    if carved or mapped.filter == "formula" or isinstance(mapped.layout, CubeSpec):
        return "lost"
    directed = not isinstance(mapped, NormalMap) or mapped.space == "tangent"
    if mapped.fine_detail == "streaks" and not (directed and surface.streaks):
        return "roughness"
    return mapped.fine_detail


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
