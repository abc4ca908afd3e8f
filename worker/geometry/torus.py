"""A ring round the y axis."""

import numpy as np

from worker.geometry.mesh import Mesh, circle, grid_triangles


def torus(radius: float, tube_radius: float, segments: int, rings: int) -> Mesh:
    """Wrap a texture round a ring: u counter-clockwise seen from above, v up on the outside.

    P = ((R + r cos b) cos a, r sin b, -(R + r cos b) sin a) with a = 2 pi u, b = 2 pi v; both seams
    have vertices equal in position and one apart in u or v.

    Source: Hughes et al., 2013, section 20.4, with y for the axis.
    """
    around_cos, around_sin = circle(segments)
    tube_cos, tube_sin = circle(rings)
    row, column = np.divmod(np.arange((rings + 1) * (segments + 1)), segments + 1)
    normals = np.stack(
        [
            tube_cos[row] * around_cos[column],
            tube_sin[row],
            -tube_cos[row] * around_sin[column],
        ],
        axis=1,
    )
    middle = np.stack([around_cos[column], np.zeros(column.size), -around_sin[column]], axis=1)
    return Mesh(
        positions=radius * middle + tube_radius * normals,
        normals=normals,
        uv_sets=(np.stack([column / segments, row / rings], axis=1),),
        triangles=grid_triangles(segments, rings),
    )
