"""A plane without an end."""

from collections.abc import Sequence

import numpy as np

from worker.geometry.facing import Facing, axes
from worker.geometry.mesh import Mesh

_CORNERS = np.array([[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]])


def infinite_plane(tile: Sequence[float], facing: Facing) -> Mesh:
    """Repeat a texture over the plane through the origin.

    Args:
        tile: Its extent along u and v.
        facing: Where the front looks; see worker.geometry.facing for what is up.
    """
    right, up, normal = axes(facing)
    return Mesh(
        positions=_CORNERS @ np.stack([tile[0] * right, tile[1] * up]),
        normals=np.tile(normal, (3, 1)),
        uv_sets=(_CORNERS,),
        triangles=np.array([[0, 1, 2]], dtype=np.uint32),
        tangents=np.tile(np.append(right, 1.0), (3, 1)),
        kind="plane",
    )
