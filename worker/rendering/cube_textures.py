"""Cubes as OpenGL textures: float32, read without seams from face to face."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.rendering.gl_context import GL, check, floats

FACES = 6


@dataclass(frozen=True, slots=True)
class CubeTexture:
    """A cube that lives in OpenGL."""

    number: int
    size_bytes: int

    @classmethod
    def upload(cls, levels: Sequence[NDArray[np.float32]]) -> "CubeTexture":
        """Copy faces to OpenGL.

        Args:
            levels: float32 (6, side, side, 3) each: +x, -x, +y, -y, +z, -z as OpenGL orients them,
                row 0 at t = 0; each side half the one before.

        Raises:
            RenderError: OpenGL has no room.
        """
        number = int(GL.glGenTextures(1))
        GL.glEnable(GL.GL_TEXTURE_CUBE_MAP_SEAMLESS)
        GL.glBindTexture(GL.GL_TEXTURE_CUBE_MAP, number)
        GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
        for level, faces in enumerate(levels):
            side = faces.shape[1]
            for face in range(FACES):
                GL.glTexImage2D(
                    GL.GL_TEXTURE_CUBE_MAP_POSITIVE_X + face,
                    level,
                    GL.GL_RGB32F,
                    side,
                    side,
                    0,
                    GL.GL_RGB,
                    GL.GL_FLOAT,
                    floats(faces[face]),
                )
        minify = GL.GL_LINEAR_MIPMAP_LINEAR if len(levels) > 1 else GL.GL_LINEAR
        for name, value in (
            (GL.GL_TEXTURE_MAX_LEVEL, len(levels) - 1),
            (GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR),
            (GL.GL_TEXTURE_MIN_FILTER, minify),
            (GL.GL_TEXTURE_WRAP_S, GL.GL_CLAMP_TO_EDGE),
            (GL.GL_TEXTURE_WRAP_T, GL.GL_CLAMP_TO_EDGE),
            (GL.GL_TEXTURE_WRAP_R, GL.GL_CLAMP_TO_EDGE),
        ):
            GL.glTexParameteri(GL.GL_TEXTURE_CUBE_MAP, name, value)
        GL.glBindTexture(GL.GL_TEXTURE_CUBE_MAP, 0)
        check("uploading a cube")
        return cls(number, sum(faces.nbytes for faces in levels))

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteTextures([self.number])


def faces_in(column: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the six faces (6, side, side, channels) of a column (6 side, side, channels)."""
    side = column.shape[1]
    return column.reshape(FACES, side, side, -1)
