"""Float framebuffers: where samples are drawn, and where they are resolved to pixels."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import PixelFilter
from worker.errors import RenderError
from worker.rendering.chunks import chunk, join
from worker.rendering.gl_context import GL
from worker.rendering.packing import ATTACHMENTS, AVERAGED
from worker.rendering.pixel_filters import apron, weights
from worker.rendering.programs import Program


@dataclass(frozen=True, slots=True)
class Target:
    """RGBA float32 textures to draw into, with or without a float32 depth buffer.

    The first is the picture; with `packing.ATTACHMENTS` of them the others are layers.
    """

    framebuffer: int
    textures: tuple[int, ...]
    depth: int | None
    width: int
    height: int

    @classmethod
    def create(cls, width: int, height: int, *, attachments: int, depth: bool) -> "Target":
        """Allocate a framebuffer of one size.

        Raises:
            RenderError: OpenGL has no such framebuffer.
        """
        framebuffer = int(GL.glGenFramebuffers(1))
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, framebuffer)
        places = [GL.GL_COLOR_ATTACHMENT0 + index for index in range(attachments)]
        textures = tuple(_texture(width, height) for _ in places)
        for place, texture in zip(places, textures, strict=True):
            GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, place, GL.GL_TEXTURE_2D, texture, 0)
        GL.glDrawBuffers(attachments, places)
        buffer = _depth_buffer(width, height) if depth else None
        status = int(GL.glCheckFramebufferStatus(GL.GL_FRAMEBUFFER))
        if status != int(GL.GL_FRAMEBUFFER_COMPLETE):
            raise RenderError(f"a {width} x {height} float framebuffer is incomplete: {status:#x}")
        return cls(framebuffer, textures, buffer, width, height)

    @property
    def layered(self) -> bool:
        """Whether there are layers beside the picture."""
        return len(self.textures) > 1

    def draw_into_all(self) -> None:
        """Let what is drawn into it, it is bound, go to all its textures."""
        places = [GL.GL_COLOR_ATTACHMENT0 + index for index in range(len(self.textures))]
        GL.glDrawBuffers(len(places), places)

    def write(self, *, averaged: bool, nearest: bool) -> None:
        """Choose which layers the next draws change; the picture always is.

        What lets light through changes only the layers that are averaged, what is no thing none.
        """
        for index in range(1, len(self.textures)):
            on = averaged if index < AVERAGED else nearest
            GL.glColorMaski(index, on, on, on, on)

    def read(self, attachment: int, width: int, height: int) -> NDArray[np.float32]:
        """Copy the lower left part of an attachment: (height, width, 4), top row first."""
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self.framebuffer)
        GL.glReadBuffer(GL.GL_COLOR_ATTACHMENT0 + attachment)
        rows = np.empty((height, width, 4), dtype=np.float32)
        GL.glReadPixels(0, 0, width, height, GL.GL_RGBA, GL.GL_FLOAT, rows)
        return rows[::-1]

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteFramebuffers(1, [self.framebuffer])
        GL.glDeleteTextures(list(self.textures))
        if self.depth is not None:
            GL.glDeleteRenderbuffers(1, [self.depth])


class TargetPair:
    """The sample target and the pixel target of the last size asked for."""

    def __init__(self) -> None:
        """Begin without targets; they are allocated when a size is known."""
        self._samples: Target | None = None
        self._pixels: Target | None = None
        self._programs: dict[str, Program] = {}
        self._no_vertices = 0

    def fit(
        self,
        width: int,
        height: int,
        supersampling: int,
        *,
        layered: bool,
        pixel_filter: PixelFilter = "box",
    ) -> Target:
        """Return a sample target for tiles of so many pixels, kept until another one is needed."""
        attachments = ATTACHMENTS if layered else 1
        more = 2 * apron(pixel_filter)
        size = ((width + more) * supersampling, (height + more) * supersampling)
        self._samples = _fitting(self._samples, size, attachments, depth=True)
        if layered or supersampling > 1 or more:
            self._pixels = _fitting(self._pixels, (width, height), attachments, depth=False)
        return self._samples

    def resolve(
        self, width: int, height: int, supersampling: int, pixel_filter: PixelFilter = "box"
    ) -> Target:
        """Make pixels of the samples in the sample target.

        Args:
            width: Of the tile in pixels.
            height: Of the tile in pixels.
            supersampling: Samples per pixel along each side.
            pixel_filter: How they become a pixel's light. What is known of a thing is still that
                of the nearest sample in the pixel itself.

        Returns:
            The target whose lower left part holds the pixels.
        """
        assert self._samples is not None
        layered, plain = self._samples.layered, pixel_filter == "box"
        if supersampling == 1 and plain and not layered:
            return self._samples
        assert self._pixels is not None
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._pixels.framebuffer)
        GL.glViewport(0, 0, width, height)
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_CULL_FACE)
        GL.glDisable(GL.GL_BLEND)
        self._samples.write(averaged=True, nearest=True)
        if layered or plain:
            program = self._program("resolve_layers.frag" if layered else "resolve.frag")
            program.bind()
            if layered:
                program.set("apron", apron(pixel_filter))
            self._fill(program, self._samples.textures, supersampling)
        if not plain:
            program = self._program("resolve_filtered.frag")
            program.bind()
            program.set("weights", weights(pixel_filter, supersampling))
            for index in range(AVERAGED if layered else 1):
                GL.glDrawBuffers(1, [GL.GL_COLOR_ATTACHMENT0 + index])
                self._fill(program, self._samples.textures[index : index + 1], supersampling)
            self._pixels.draw_into_all()
        return self._pixels

    def _fill(self, program: Program, samples: Sequence[int], supersampling: int) -> None:
        """Draw the bound program over the whole target."""
        for unit, texture in enumerate(samples):
            GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
            GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
            GL.glBindSampler(unit, 0)
            program.set(f"samples_{unit}", unit)
        program.set("samples_per_side", supersampling)
        GL.glBindVertexArray(self._no_vertices)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glBindVertexArray(0)
        for unit in range(len(samples)):
            GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
            GL.glBindTexture(GL.GL_TEXTURE_2D, 0)

    def trim(self) -> None:
        """Free targets with layers, which are large and seldom wanted."""
        if self._samples is not None and self._samples.layered:
            self._free()

    def delete(self) -> None:
        """Free everything."""
        self._free()
        for program in self._programs.values():
            program.delete()
        if self._no_vertices:
            GL.glDeleteVertexArrays(1, [self._no_vertices])
        self.__init__()  # type: ignore[misc]

    def _free(self) -> None:
        for held in (self._samples, self._pixels):
            if held is not None:
                held.delete()
        self._samples = self._pixels = None

    def _program(self, fragment: str) -> Program:
        if fragment not in self._programs:
            names = ("whole_target.vert", fragment)
            self._programs[fragment] = Program.link(*(join(chunk(name), name) for name in names))
            self._no_vertices = self._no_vertices or int(GL.glGenVertexArrays(1))
        return self._programs[fragment]


def _fitting(
    held: Target | None, size: tuple[int, int], attachments: int, *, depth: bool
) -> Target:
    if held is not None:
        if (held.width, held.height, len(held.textures)) == (*size, attachments):
            return held
        held.delete()
    return Target.create(*size, attachments=attachments, depth=depth)


def _texture(width: int, height: int) -> int:
    texture = int(GL.glGenTextures(1))
    GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
    GL.glTexImage2D(
        GL.GL_TEXTURE_2D, 0, GL.GL_RGBA32F, width, height, 0, GL.GL_RGBA, GL.GL_FLOAT, None
    )
    GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_NEAREST)
    GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MAG_FILTER, GL.GL_NEAREST)
    GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
    return texture


def _depth_buffer(width: int, height: int) -> int:
    buffer = int(GL.glGenRenderbuffers(1))
    GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
    GL.glRenderbufferStorage(GL.GL_RENDERBUFFER, GL.GL_DEPTH_COMPONENT32F, width, height)
    GL.glFramebufferRenderbuffer(
        GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, GL.GL_RENDERBUFFER, buffer
    )
    return buffer
