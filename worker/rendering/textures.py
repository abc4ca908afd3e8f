"""Pictures as OpenGL textures: float32, with mip levels made on the CPU."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Meaning
from worker.rendering.gl_context import GL, check, floats

_INTERNAL = {1: GL.GL_R32F, 2: GL.GL_RG32F, 3: GL.GL_RGB32F, 4: GL.GL_RGBA32F}
_LAYOUT = {1: GL.GL_RED, 2: GL.GL_RG, 3: GL.GL_RGB, 4: GL.GL_RGBA}
_GREY = (GL.GL_RED, GL.GL_RED, GL.GL_RED, GL.GL_ONE)
_GREY_ALPHA = (GL.GL_RED, GL.GL_RED, GL.GL_RED, GL.GL_GREEN)


@dataclass(frozen=True, slots=True)
class TextureFormat:
    """What of a texture the JIT compiles into the code that reads it.

    Attributes:
        channels: 1..4. A grey reads as three equal channels; a missing alpha reads as 1.
        meaning: Two channels of a colour are grey and alpha, of data red and green.
        powers_of_two: Whether width and height are powers of two.
        levels: Whether it has more than one level.
    """

    channels: int
    meaning: Meaning
    powers_of_two: tuple[bool, bool]
    levels: bool


@dataclass(frozen=True, slots=True)
class Texture:
    """A texture that lives in OpenGL, with the size of the picture in it."""

    number: int
    width: int
    height: int
    format: TextureFormat
    size_bytes: int

    @classmethod
    def upload(
        cls,
        levels: Sequence[NDArray[np.float32]],
        meaning: Meaning,
        size: tuple[int, int] | None = None,
    ) -> "Texture":
        """Copy a picture and its smaller levels to OpenGL.

        Args:
            levels: float32 (height, width, channels) each, level 0 first, row 0 at the top; each
                side half the one before, rounded down. One level has no smaller ones.
            meaning: What the channels are.
            size: Width and height of the picture that a table stands for.

        Raises:
            RenderError: OpenGL has no room.
        """
        height, width, channels = levels[0].shape
        number = int(GL.glGenTextures(1))
        GL.glBindTexture(GL.GL_TEXTURE_2D, number)
        GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
        for index, level in enumerate(levels):
            GL.glTexImage2D(
                GL.GL_TEXTURE_2D,
                index,
                _INTERNAL[channels],
                level.shape[1],
                level.shape[0],
                0,
                _LAYOUT[channels],
                GL.GL_FLOAT,
                floats(level[::-1]),  # v is up: OpenGL's first row is the lowest
            )
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MAX_LEVEL, len(levels) - 1)
        if channels == 1 or (channels == 2 and meaning == "colour"):
            swizzle = np.array(_GREY if channels == 1 else _GREY_ALPHA, dtype=np.int32)
            GL.glTexParameteriv(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_SWIZZLE_RGBA, swizzle)
        GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
        check("uploading a texture")
        return cls(
            number=number,
            width=size[0] if size else width,
            height=size[1] if size else height,
            format=TextureFormat(
                channels=channels,
                meaning=meaning,
                powers_of_two=(width & (width - 1) == 0, height & (height - 1) == 0),
                levels=len(levels) > 1,
            ),
            size_bytes=sum(level.nbytes for level in levels),
        )

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteTextures([self.number])
