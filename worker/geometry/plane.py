"""A rectangle."""

import numpy as np

from worker.geometry.facing import Facing, axes
from worker.geometry.mesh import Mesh, grid_triangles


def plane(width: float, height: float, facing: Facing, offset: float = 0.0) -> Mesh:
    """Lay a whole texture on a rectangle with its middle on the axis it faces along.

    Args:
        width: Extent along the texture's u.
        height: Extent along the texture's v.
        facing: Where the front looks; see worker.geometry.facing for what is up.
        offset: Distance from the origin along facing.
    """
    right, up, normal = axes(facing)
    uv = np.array([[0, 0], [1, 0], [0, 1], [1, 1]], dtype=np.float64)
    return Mesh(
        positions=(uv - 0.5) @ np.stack([width * right, height * up]) + offset * normal,
        normals=np.tile(normal, (4, 1)),
        uv_sets=(uv,),
        triangles=grid_triangles(1, 1),
    )
