"""A flat disc."""

import numpy as np

from worker.geometry.facing import Facing, axes
from worker.geometry.mesh import Mesh, circle


def disk(radius: float, segments: int, facing: Facing, offset: float = 0.0) -> Mesh:
    """Cut the inscribed circle out of a texture: (u, v) = (1 + (x, y) / radius) / 2 in its plane.

    Args:
        radius: From the middle to the rim's corners.
        segments: Corners of the rim, each with one triangle to the middle.
        facing: Where the front looks; see worker.geometry.facing for what is up.
        offset: Distance from the origin along facing.
    """
    right, up, normal = axes(facing)
    cosine, sine = circle(segments)
    plane = np.vstack([[0.0, 0.0], np.stack([cosine, sine], axis=1)[:segments]])
    rim = np.arange(segments)
    return Mesh(
        positions=radius * plane @ np.stack([right, up]) + offset * normal,
        normals=np.tile(normal, (segments + 1, 1)),
        uv_sets=((1 + plane) / 2,),
        triangles=np.stack([np.zeros_like(rim), 1 + rim, 1 + (rim + 1) % segments], axis=1).astype(
            np.uint32
        ),
    )
