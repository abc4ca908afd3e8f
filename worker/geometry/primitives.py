"""From a request's mesh to triangles."""

from typing import assert_never

from api_schemas import meshes
from worker.geometry.box import box
from worker.geometry.cylinder import cylinder
from worker.geometry.disk import disk
from worker.geometry.infinite_plane import infinite_plane
from worker.geometry.mesh import Mesh
from worker.geometry.plane import plane
from worker.geometry.sphere import sphere
from worker.geometry.torus import torus


def build(spec: meshes.Primitive) -> Mesh:
    """Make the mesh that a request describes."""
    match spec:
        case meshes.Cylinder():
            return cylinder(spec.radius, spec.height, spec.segments, spec.rows, caps=spec.caps)
        case meshes.Sphere():
            return sphere(spec.radius, spec.segments, spec.rings, flip_u=spec.flip_u)
        case meshes.Plane():
            return plane(spec.width, spec.height, spec.facing)
        case meshes.Disk():
            return disk(spec.radius, spec.segments, spec.facing)
        case meshes.Box():
            return box(spec.width, spec.height, spec.depth)
        case meshes.InfinitePlane():
            return infinite_plane(spec.tile, spec.facing)
        case meshes.Torus():
            return torus(spec.radius, spec.tube_radius, spec.segments, spec.rings)
    assert_never(spec)
