"""Meshes in OpenGL memory: one buffer of vertices, fixed attribute locations, one of indices."""

import ctypes
import functools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import UV_SETS_MAX, Mesh
from worker.rendering.draw_order import is_convex
from worker.rendering.gl_context import GL, check, floats

_POSITION, _NORMAL, _TANGENT, _COLOUR, _UV = range(5)  # the locations of mesh.vert
_MODES = {
    "triangles": GL.GL_TRIANGLES,
    "lines": GL.GL_LINES,
    "points": GL.GL_POINTS,
    "plane": GL.GL_TRIANGLES,
}
_FLOAT_BYTES = 4


@dataclass(frozen=True, eq=False)
class VertexArray:
    """A mesh in OpenGL.

    Attributes:
        number: The vertex array object.
        buffers: Of vertices and of indices.
        mode: What the indices are: GL_TRIANGLES, GL_LINES or GL_POINTS.
        positions: float32 (n, 3), as OpenGL holds them.
        elements: uint32 (m, 3) of triangles, (m, 2) of lines, (m, 1) of points.
        size_bytes: What it holds, in OpenGL and here.
        tile: Of a plane without end, float64 (2, 3): one texture's extent along u and along v.
    """

    number: int
    buffers: tuple[int, int]
    mode: int
    positions: NDArray[np.float32]
    elements: NDArray[np.uint32]
    size_bytes: int
    tile: NDArray[np.float64] | None = None

    @classmethod
    def upload(cls, mesh: Mesh) -> "VertexArray":
        """Copy a mesh to OpenGL.

        Every uv set that a shader may ask for is there: set 0 stands in for those the mesh lacks.
        What else it lacks reads as a constant: colour as white, uv as (0, 0).

        Raises:
            RenderError: OpenGL has no room.
        """
        number = int(GL.glGenVertexArrays(1))
        vertices, indices = (int(buffer) for buffer in GL.glGenBuffers(2))
        GL.glBindVertexArray(number)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, vertices)
        columns = _columns(mesh)
        data = floats(np.concatenate([values for _, values in columns], axis=1))
        GL.glBufferData(GL.GL_ARRAY_BUFFER, data.nbytes, data, GL.GL_STATIC_DRAW)
        offset = 0
        for locations, values in columns:
            for location in locations:
                GL.glEnableVertexAttribArray(location)
                GL.glVertexAttribPointer(
                    location,
                    values.shape[1],
                    GL.GL_FLOAT,
                    False,
                    data.shape[1] * _FLOAT_BYTES,
                    ctypes.c_void_p(offset * _FLOAT_BYTES),
                )
            offset += values.shape[1]
        GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, indices)
        rows = np.ascontiguousarray(mesh.triangles, dtype=np.uint32)
        GL.glBufferData(GL.GL_ELEMENT_ARRAY_BUFFER, rows.nbytes, rows, GL.GL_STATIC_DRAW)
        GL.glBindVertexArray(0)
        check("uploading a mesh")
        positions = floats(mesh.positions)
        return cls(
            number=number,
            buffers=(vertices, indices),
            mode=_MODES[mesh.kind],
            positions=positions,
            elements=rows,
            size_bytes=data.nbytes + 2 * rows.nbytes + positions.nbytes,
            tile=np.diff(mesh.positions[[0, 1, 0, 2]], axis=0)[::2] / 4
            if mesh.kind == "plane"
            else None,
        )

    @functools.cached_property
    def bounds(self) -> NDArray[np.float64]:
        """Lower and upper corner of its bounding box, (2, 3)."""
        corners = [self.positions.min(axis=0), self.positions.max(axis=0)]
        return np.array(corners, dtype=np.float64)

    @property
    def centre(self) -> NDArray[np.float64]:
        """The middle of its bounding box, (3,)."""
        middle: NDArray[np.float64] = self.bounds.mean(axis=0)
        return middle

    @functools.cached_property
    def convex(self) -> bool:
        """Whether drawing inner sides before outer ones shows it right from everywhere."""
        return self.has_sides and is_convex(self.positions, self.elements)

    @property
    def has_sides(self) -> bool:
        """Whether it has an inner and an outer side; lines and points have none."""
        return bool(self.mode == GL.GL_TRIANGLES)

    def face_normals(self) -> NDArray[np.float32]:
        """Give the unit normal of each triangle in the object's frame, (m, 3); 0 without area."""
        corners = self.positions[self.elements].astype(np.float64)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        return floats(np.divide(normals, lengths, out=normals, where=lengths > 0))

    def bind(self) -> None:
        """Make it what is drawn."""
        GL.glBindVertexArray(self.number)
        # Not the array but the context keeps what stands for an attribute that is not there.
        GL.glVertexAttrib4f(_COLOUR, 1.0, 1.0, 1.0, 1.0)

    def draw(self) -> None:
        """Draw it all; it is bound."""
        GL.glDrawElements(self.mode, self.elements.size, GL.GL_UNSIGNED_INT, None)

    def draw_in_order(self, elements: NDArray[np.uint32], stream: int) -> None:
        """Draw elements of its own in another order, by way of a buffer for them; it is bound."""
        GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, stream)
        GL.glBufferData(GL.GL_ELEMENT_ARRAY_BUFFER, elements.nbytes, elements, GL.GL_STREAM_DRAW)
        GL.glDrawElements(self.mode, elements.size, GL.GL_UNSIGNED_INT, None)
        GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, self.buffers[1])

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteVertexArrays(1, [self.number])
        GL.glDeleteBuffers(2, list(self.buffers))


def _columns(mesh: Mesh) -> list[tuple[list[int], NDArray[np.float64]]]:
    """Give what the mesh has, each with the locations that read it."""
    columns = [([_POSITION], mesh.positions), ([_NORMAL], mesh.normals)]
    if mesh.tangents is not None:
        columns.append(([_TANGENT], mesh.tangents))
    if mesh.colors is not None:
        columns.append(([_COLOUR], mesh.colors))
    for index, uv in enumerate(mesh.uv_sets[:UV_SETS_MAX]):
        missing = range(len(mesh.uv_sets), UV_SETS_MAX) if index == 0 else ()
        columns.append(([_UV + index, *(_UV + other for other in missing)], uv))
    return columns
