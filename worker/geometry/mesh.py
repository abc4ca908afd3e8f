"""The one mesh type inside the worker."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Mesh:
    """Triangles with a normal and texture coordinates at every vertex.

    The arrays are not copied: treat them as read-only.

    Attributes:
        positions: float64 (n, 3), in the object's frame.
        normals: float64 (n, 3), unit length, outward.
        uv: float64 (n, 2), u to the right and v up on the texture.
        triangles: uint32 (m, 3), counter-clockwise seen from outside.
    """

    positions: NDArray[np.float64]
    normals: NDArray[np.float64]
    uv: NDArray[np.float64]
    triangles: NDArray[np.uint32]

    @property
    def size_bytes(self) -> int:
        """What the four arrays occupy."""
        arrays = (self.positions, self.normals, self.uv, self.triangles)
        return sum(array.nbytes for array in arrays)


def join(meshes: list[Mesh]) -> Mesh:
    """Put meshes into one, keeping the order of their vertices and triangles."""
    starts = np.cumsum([0] + [len(mesh.positions) for mesh in meshes[:-1]])
    return Mesh(
        positions=np.concatenate([mesh.positions for mesh in meshes]),
        normals=np.concatenate([mesh.normals for mesh in meshes]),
        uv=np.concatenate([mesh.uv for mesh in meshes]),
        triangles=np.concatenate(
            [mesh.triangles + start for mesh, start in zip(meshes, starts, strict=True)]
        ).astype(np.uint32),
    )


def grid_triangles(columns: int, rows: int) -> NDArray[np.uint32]:
    """Split each cell of a grid into two triangles, counter-clockwise if column x row is outward.

    Vertex (column i, row j) has index j (columns + 1) + i, for i in 0..columns and j in 0..rows.

    Returns:
        uint32 (2 columns rows, 3), two per cell, row by row.
    """
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    right, above = corner + 1, corner + columns + 1
    lower = np.stack([corner, right, above], axis=1)
    upper = np.stack([right, above + 1, above], axis=1)
    return np.stack([lower, upper], axis=1).reshape(-1, 3).astype(np.uint32)


def circle(segments: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Give cosine and sine of 0..segments equal steps round; the last equals the first, exactly."""
    angle = 2 * np.pi * (np.arange(segments + 1) % segments) / segments
    return np.cos(angle), np.sin(angle)
