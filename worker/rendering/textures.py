"""Pictures as OpenGL textures: float32, with mip levels made on the CPU."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Meaning
from worker.rendering.gl_context import GL, check, floats

_INTERNAL = {1: GL.GL_R32F, 2: GL.GL_RG32F, 3: GL.GL_RGB32F, 4: GL.GL_RGBA32F}
_LAYOUT = {1: GL.GL_RED, 2: GL.GL_RG, 3: GL.GL_RGB, 4: GL.GL_RGBA}
_GREY = (GL.GL_RED, GL.GL_RED, GL.GL_RED, GL.GL_ONE)
_GREY_ALPHA = (GL.GL_RED, GL.GL_RED, GL.GL_RED, GL.GL_GREEN)


Kind = Literal["picture", "volume", "cube"]
_TARGETS = {
    "picture": GL.GL_TEXTURE_2D,
    "volume": GL.GL_TEXTURE_3D,
    "cube": GL.GL_TEXTURE_CUBE_MAP,
}


@dataclass(frozen=True, slots=True)
class TextureFormat:
    """What of a texture the JIT compiles into the code that reads it.

    Attributes:
        channels: 1..4. A grey reads as three equal channels; a missing alpha reads as 1.
        meaning: Two channels of a colour are grey and alpha, of data red and green.
        powers_of_two: Whether width and height are powers of two.
        levels: Whether it has more than one level.
        kind: Whether it is a picture, fills space, or has six faces.
    """

    channels: int
    meaning: Meaning
    powers_of_two: tuple[bool, bool]
    levels: bool
    kind: Kind = "picture"


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
            size: Height and width of the picture that a table stands for.

        Raises:
            RenderError: OpenGL has no room.
        """
        number = _new("picture", len(levels), levels[0].shape[-1], meaning)
        for index, level in enumerate(levels):
            height, width, channels = level.shape
            kind = (_INTERNAL[channels], width, height, 0, _LAYOUT[channels], GL.GL_FLOAT)
            # v is up: OpenGL's first row is the lowest
            GL.glTexImage2D(GL.GL_TEXTURE_2D, index, *kind, floats(level[::-1]))
        return _finished(number, "picture", size or levels[0].shape[:2], levels, meaning)

    @classmethod
    def upload_volume(cls, levels: Sequence[NDArray[np.float32]], meaning: Meaning) -> "Texture":
        """Copy a volume and its smaller levels to OpenGL.

        Args:
            levels: float32 (depth, height, width, channels) each, row 0 at the top of a slice.
            meaning: What the channels are.

        Raises:
            RenderError: OpenGL has no room.
        """
        number = _new("volume", len(levels), levels[0].shape[-1], meaning)
        for index, level in enumerate(levels):
            depth, height, width, channels = level.shape
            kind = (_INTERNAL[channels], width, height, depth, 0, _LAYOUT[channels], GL.GL_FLOAT)
            GL.glTexImage3D(GL.GL_TEXTURE_3D, index, *kind, floats(level[:, ::-1]))
        return _finished(number, "volume", levels[0].shape[1:3], levels, meaning)

    @classmethod
    def upload_cube(
        cls, faces: Sequence[Sequence[NDArray[np.float32]]], meaning: Meaning
    ) -> "Texture":
        """Copy six faces and their smaller levels to OpenGL.

        Args:
            faces: +x, -x, +y, -y, +z, -z as OpenGL has them, each its levels, float32 (side, side,
                channels), row 0 where t = 0.
            meaning: What the channels are.

        Raises:
            RenderError: OpenGL has no room.
        """
        number = _new("cube", len(faces[0]), faces[0][0].shape[-1], meaning)
        for face, levels in enumerate(faces):
            for index, level in enumerate(levels):
                side, _, channels = level.shape
                kind = (_INTERNAL[channels], side, side, 0, _LAYOUT[channels], GL.GL_FLOAT)
                target = GL.GL_TEXTURE_CUBE_MAP_POSITIVE_X + face
                GL.glTexImage2D(target, index, *kind, floats(level))
        kept = [level for levels in faces for level in levels]
        return _finished(number, "cube", faces[0][0].shape[:2], kept, meaning)

    @property
    def target(self) -> int:
        """What it is bound to."""
        return int(_TARGETS[self.format.kind])

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteTextures([self.number])


def _new(kind: Kind, levels: int, channels: int, meaning: Meaning) -> int:
    """Bind a new texture whose channels are read as a sampler should see them."""
    number, target = int(GL.glGenTextures(1)), _TARGETS[kind]
    GL.glBindTexture(target, number)
    GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
    GL.glTexParameteri(target, GL.GL_TEXTURE_MAX_LEVEL, levels - 1)
    if channels == 1 or (channels == 2 and meaning == "colour"):
        swizzle = np.array(_GREY if channels == 1 else _GREY_ALPHA, dtype=np.int32)
        GL.glTexParameteriv(target, GL.GL_TEXTURE_SWIZZLE_RGBA, swizzle)
    return number


def _finished(
    number: int,
    kind: Kind,
    size: tuple[int, ...],
    levels: Sequence[NDArray[np.float32]],
    meaning: Meaning,
) -> Texture:
    GL.glBindTexture(_TARGETS[kind], 0)
    check("uploading a texture")
    height, width = size
    held = levels[0].shape[-3:-1]  # of a table another size
    return Texture(
        number=number,
        width=width,
        height=height,
        format=TextureFormat(
            channels=levels[0].shape[-1],
            meaning=meaning,
            powers_of_two=(held[1] & (held[1] - 1) == 0, held[0] & (held[0] - 1) == 0),
            levels=len({level.shape for level in levels}) > 1,
            kind=kind,
        ),
        size_bytes=sum(level.nbytes for level in levels),
    )
