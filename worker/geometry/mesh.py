"""The one mesh type inside the worker."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

MeshKind = Literal["triangles", "lines", "points", "plane"]
UV_SETS_MAX = 4
"""Sets of texture coordinates that are drawn; a reader ignores more."""


@dataclass(frozen=True, slots=True)
class Mesh:
    """Triangles, lines or points, with what is known at every vertex.

    The arrays are not copied: treat them as read-only.

    Attributes:
        positions: float64 (n, 3), in the object's frame.
        normals: float64 (n, 3), unit length, outward. Lines and points that have none hold zeros:
            they have no side that light could fall on, and show their colour as it is.
        uv_sets: 0..4 arrays float64 (n, 2), u to the right and v up on the texture.
        triangles: uint32 (m, 3), counter-clockwise seen from outside; (m, 2) of lines, (m, 1) of
            points.
        tangents: float64 (n, 4), where u grows, unit length; the last is the sign of the bitangent,
            sign * cross(normal, tangent). None: computed where a normal map asks for them.
        colors: float64 (n, 4), linear, straight alpha. None: white.
        kind: What a row of `triangles` is; the one triangle of a plane, whose uv are (-1, -1),
            (3, -1), (-1, 3), stands for all of it, without an end.
    """

    positions: NDArray[np.float64]
    normals: NDArray[np.float64]
    uv_sets: tuple[NDArray[np.float64], ...]
    triangles: NDArray[np.uint32]
    tangents: NDArray[np.float64] | None = None
    colors: NDArray[np.float64] | None = None
    kind: MeshKind = "triangles"

    def uv(self, index: int = 0) -> NDArray[np.float64]:
        """Return a set of texture coordinates, or set 0 in its place, or zeros without any."""
        if not self.uv_sets:
            return np.zeros((len(self.positions), 2))
        return self.uv_sets[index if index < len(self.uv_sets) else 0]

    @property
    def size_bytes(self) -> int:
        """What the arrays occupy."""
        optional = [array for array in (self.tangents, self.colors) if array is not None]
        arrays = (self.positions, self.normals, *self.uv_sets, *optional)
        return self.triangles.nbytes + sum(array.nbytes for array in arrays)


def join(meshes: list[Mesh]) -> Mesh:
    """Put triangles with one uv set and no more into one, keeping the order of everything."""
    starts = np.cumsum([0] + [len(mesh.positions) for mesh in meshes[:-1]])
    return Mesh(
        positions=np.concatenate([mesh.positions for mesh in meshes]),
        normals=np.concatenate([mesh.normals for mesh in meshes]),
        uv_sets=(np.concatenate([mesh.uv() for mesh in meshes]),),
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
    """Give cosine and sine of 0..segments equal steps round.

    The last equals the first and the second half mirrors the first one, to the last bit: what runs
    round the other way has its vertices at the same places.
    """
    step = np.arange(segments + 1) % segments
    angle = 2 * np.pi * np.minimum(step, segments - step) / segments
    sine = np.where(2 * step == segments, 0.0, np.sin(angle))
    return np.cos(angle), np.where(2 * step > segments, -sine, sine)
