"""What a model file tells of itself, without the files beside it."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from worker.geometry.mesh import Mesh

Corner = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Outline:
    """What there is in a model; names are by index, empty where the file gives none.

    Attributes:
        triangles: How many are drawn; so with lines, points and the vertices of all three.
        lines: See triangles.
        points: See triangles.
        vertices: See triangles.
        draws: Meshes with one material each that are drawn.
        bounds: Lowest and highest corner of the default scene; None if it is empty.
        uv_sets: The most that any mesh has.
        has_normals: Whether the file brings any; so with tangents and colours of vertices.
        has_tangents: See has_normals.
        has_vertex_colours: See has_normals.
        materials: Names.
        nodes: Names.
        cameras: Names.
        scenes: How many, where the format has such.
        lights: How many.
        pictures: Encoded picture files inside the file, each once.
        files: Names of the files that it needs beside it.
        warnings: What it asks for and will not get.
    """

    triangles: int
    lines: int
    points: int
    vertices: int
    draws: int
    bounds: tuple[Corner, Corner] | None
    uv_sets: int
    has_normals: bool
    has_tangents: bool
    has_vertex_colours: bool
    materials: tuple[str, ...] = ()
    nodes: tuple[str, ...] = ()
    cameras: tuple[str, ...] = ()
    scenes: int = 0
    lights: int = 0
    pictures: tuple[bytes, ...] = ()
    files: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def outline_of(
    meshes: Iterable[Mesh],
    *,
    has_normals: bool,
    materials: tuple[str, ...] = (),
    nodes: tuple[str, ...] = (),
    files: tuple[str, ...] = (),
    warnings: tuple[str, ...] = (),
) -> Outline:
    """Count what lies in meshes that stand in the model's own frame, each drawn once."""
    listed = list(meshes)
    drawn = {"triangles": 0, "lines": 0, "points": 0}
    for mesh in listed:
        drawn[mesh.kind] += len(mesh.triangles)
    lowest = np.min([mesh.positions.min(axis=0) for mesh in listed], axis=0).tolist()
    highest = np.max([mesh.positions.max(axis=0) for mesh in listed], axis=0).tolist()
    return Outline(
        triangles=drawn["triangles"],
        lines=drawn["lines"],
        points=drawn["points"],
        vertices=sum(len(mesh.positions) for mesh in listed),
        draws=len(listed),
        bounds=(lowest, highest),
        uv_sets=max(len(mesh.uv_sets) for mesh in listed),
        has_normals=has_normals,
        has_tangents=False,
        has_vertex_colours=any(mesh.colors is not None for mesh in listed),
        materials=materials,
        nodes=nodes,
        files=files,
        warnings=warnings,
    )
