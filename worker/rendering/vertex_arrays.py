"""Meshes in OpenGL memory: one buffer of vertices, fixed attribute locations, one of indices."""

import ctypes
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import UV_SETS_MAX, Mesh
from worker.rendering.gl_context import GL, check, floats

_POSITION, _NORMAL, _TANGENT, _COLOUR, _UV = range(5)  # the locations of mesh.vert
_MODES = {"triangles": GL.GL_TRIANGLES, "lines": GL.GL_LINES, "points": GL.GL_POINTS}
_FLOAT_BYTES = 4


@dataclass(frozen=True, slots=True)
class VertexArray:
    """A mesh in OpenGL.

    Attributes:
        number: The vertex array object.
        buffers: Of vertices and of indices.
        mode: What the indices are: GL_TRIANGLES, GL_LINES or GL_POINTS.
        count: How many indices there are.
    """

    number: int
    buffers: tuple[int, int]
    mode: int
    count: int

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
        return cls(number, (vertices, indices), _MODES[mesh.kind], rows.size)

    @property
    def has_sides(self) -> bool:
        """Whether it has an inner and an outer side; lines and points have none."""
        return bool(self.mode == _MODES["triangles"])

    def bind(self) -> None:
        """Make it what is drawn."""
        GL.glBindVertexArray(self.number)
        # Not the array but the context keeps what stands for an attribute that is not there.
        GL.glVertexAttrib4f(_COLOUR, 1.0, 1.0, 1.0, 1.0)

    def draw(self) -> None:
        """Draw it all; it is bound."""
        GL.glDrawElements(self.mode, self.count, GL.GL_UNSIGNED_INT, None)

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
