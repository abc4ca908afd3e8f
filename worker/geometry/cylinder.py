"""A can standing on y = 0."""

import numpy as np

from worker.geometry.disk import disk
from worker.geometry.mesh import Mesh, circle, grid_triangles, join


def cylinder(radius: float, height: float, segments: int, rows: int, *, caps: bool = False) -> Mesh:
    """Roll a texture round a can: u counter-clockwise seen from above, v upwards.

    P(i, j) = (r cos a, h j / rows, -r sin a) with a = 2 pi i / segments, (u, v) = (i / segments,
    j / rows). The seam has two columns of vertices, equal in position and one apart in u. Caps
    show the texture's inscribed disc, upright for who looks at them with the front, +z, down
    (lid) or up (bottom).

    Source: Hughes et al., 2013, section 20.1, with y for the axis.
    """
    cosine, sine = circle(segments)
    level, column = np.divmod(np.arange((rows + 1) * (segments + 1)), segments + 1)
    normals = np.stack([cosine[column], np.zeros(column.size), -sine[column]], axis=1)
    positions = radius * normals
    positions[:, 1] = height * level / rows
    wall = Mesh(
        positions=positions,
        normals=normals,
        uv_sets=(np.stack([column / segments, level / rows], axis=1),),
        triangles=grid_triangles(segments, rows),
    )
    if not caps:
        return wall
    return join([wall, disk(radius, segments, "-y"), disk(radius, segments, "+y", height)])
