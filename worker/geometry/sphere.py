"""A globe with its poles on y."""

import numpy as np

from worker.geometry.mesh import Mesh, circle, grid_triangles


def sphere(radius: float, segments: int, rings: int, *, flip_u: bool = True) -> Mesh:
    """Wrap a texture round a globe, v from the south to the north pole.

    P = r (cos t cos p, sin p, sin t cos p), t in 0..2 pi round y and p in -pi/2..pi/2. With flip_u,
    (u, v) = (1 - t / 2 pi, 1/2 + p / pi) and the texture reads from outside; without it
    u = t / 2 pi and it reads from inside. Each triangle at a pole has a pole vertex of its own,
    with the u of the triangle's middle.

    Source: Hughes et al., 2013, equations 20.5 and 20.6.
    """
    cosine, sine = circle(segments)
    row, column = np.divmod(np.arange((rings + 1) * (segments + 1)), segments + 1)
    pole = (row == 0) | (row == rings)
    latitude = np.pi * (row / rings - 0.5)
    across = np.where(pole, 0.0, np.cos(latitude))
    normals = np.stack([cosine[column] * across, np.sin(latitude), -sine[column] * across], axis=1)
    u = (column + np.where(pole, 0.5, 0.0)) / segments
    triangles = _without_slivers(grid_triangles(segments, rings), segments, rings)
    kept = ~(pole & (column == segments))
    number = np.cumsum(kept) - 1
    return Mesh(
        positions=radius * normals[kept],
        normals=normals[kept],
        uv_sets=(np.stack([u if flip_u else 1 - u, row / rings], axis=1)[kept],),
        triangles=number[triangles].astype(np.uint32),
    )


def _without_slivers(triangles: np.ndarray, segments: int, rings: int) -> np.ndarray:
    """Keep one triangle per cell at the poles, where a cell's other one has no area."""
    cells = triangles.reshape(rings, segments, 2, 3)
    south = cells[0, :, 1].copy()
    south[:, 0] = np.arange(segments)
    return np.concatenate([south, cells[1:-1].reshape(-1, 3), cells[-1, :, 0]])
