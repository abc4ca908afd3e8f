"""Float framebuffers: where samples are drawn, and where they are averaged to pixels."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.errors import RenderError
from worker.rendering.chunks import chunk, join
from worker.rendering.gl_context import GL
from worker.rendering.programs import Program


@dataclass(frozen=True, slots=True)
class Target:
    """An RGBA float32 texture to draw into, with or without a float32 depth buffer."""

    framebuffer: int
    colour: int
    depth: int | None
    width: int
    height: int

    @classmethod
    def create(cls, width: int, height: int, *, depth: bool) -> "Target":
        """Allocate a framebuffer of one size.

        Raises:
            RenderError: OpenGL has no such framebuffer.
        """
        framebuffer = int(GL.glGenFramebuffers(1))
        colour = int(GL.glGenTextures(1))
        GL.glBindTexture(GL.GL_TEXTURE_2D, colour)
        GL.glTexImage2D(
            GL.GL_TEXTURE_2D, 0, GL.GL_RGBA32F, width, height, 0, GL.GL_RGBA, GL.GL_FLOAT, None
        )
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_NEAREST)
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MAG_FILTER, GL.GL_NEAREST)
        GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, framebuffer)
        GL.glFramebufferTexture2D(
            GL.GL_FRAMEBUFFER, GL.GL_COLOR_ATTACHMENT0, GL.GL_TEXTURE_2D, colour, 0
        )
        buffer = _depth_buffer(width, height) if depth else None
        status = int(GL.glCheckFramebufferStatus(GL.GL_FRAMEBUFFER))
        if status != int(GL.GL_FRAMEBUFFER_COMPLETE):
            raise RenderError(f"a {width} x {height} float framebuffer is incomplete: {status:#x}")
        return cls(framebuffer, colour, buffer, width, height)

    def read(self, width: int, height: int, out: NDArray[np.float32]) -> None:
        """Copy the lower left part of the target into (height, width, 4), top row first."""
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self.framebuffer)
        rows = np.empty((height, width, 4), dtype=np.float32)
        GL.glReadPixels(0, 0, width, height, GL.GL_RGBA, GL.GL_FLOAT, rows)
        out[:] = rows[::-1]

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteFramebuffers(1, [self.framebuffer])
        GL.glDeleteTextures([self.colour])
        if self.depth is not None:
            GL.glDeleteRenderbuffers(1, [self.depth])


class TargetPair:
    """The sample target and the pixel target of the last size asked for."""

    def __init__(self) -> None:
        """Begin without targets; they are allocated when a size is known."""
        self._samples: Target | None = None
        self._pixels: Target | None = None
        self._program: Program | None = None
        self._no_vertices = 0

    def fit(self, width: int, height: int, supersampling: int) -> Target:
        """Return a sample target for tiles of so many pixels, kept until another size is needed."""
        self._samples = _fitting(
            self._samples, width * supersampling, height * supersampling, depth=True
        )
        if supersampling > 1:
            self._pixels = _fitting(self._pixels, width, height, depth=False)
        return self._samples

    def resolve(self, supersampling: int, out: NDArray[np.float32]) -> None:
        """Average the samples drawn in the sample target into the pixels of `out`.

        Args:
            supersampling: Samples per pixel along each side.
            out: float32 (height, width, 4) to fill, top row first.
        """
        assert self._samples is not None
        height, width, _ = out.shape
        if supersampling == 1:
            self._samples.read(width, height, out)
            return
        assert self._pixels is not None
        if self._program is None:
            names = ("whole_target.vert", "resolve.frag")
            self._program = Program.link(*(join(chunk(name), name) for name in names))
            self._no_vertices = int(GL.glGenVertexArrays(1))
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._pixels.framebuffer)
        GL.glViewport(0, 0, width, height)
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDisable(GL.GL_CULL_FACE)
        GL.glDisable(GL.GL_BLEND)
        self._program.bind()
        GL.glActiveTexture(GL.GL_TEXTURE0)
        GL.glBindTexture(GL.GL_TEXTURE_2D, self._samples.colour)
        GL.glBindSampler(0, 0)
        self._program.set("samples", 0)
        self._program.set("samples_per_side", supersampling)
        GL.glBindVertexArray(self._no_vertices)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glBindVertexArray(0)
        GL.glBindTexture(GL.GL_TEXTURE_2D, 0)
        self._pixels.read(width, height, out)

    def delete(self) -> None:
        """Free everything."""
        for held in (self._samples, self._pixels, self._program):
            if held is not None:
                held.delete()
        if self._no_vertices:
            GL.glDeleteVertexArrays(1, [self._no_vertices])
        self.__init__()  # type: ignore[misc]


def _fitting(held: Target | None, width: int, height: int, *, depth: bool) -> Target:
    if held is not None:
        if (held.width, held.height) == (width, height):
            return held
        held.delete()
    return Target.create(width, height, depth=depth)


def _depth_buffer(width: int, height: int) -> int:
    buffer = int(GL.glGenRenderbuffers(1))
    GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
    GL.glRenderbufferStorage(GL.GL_RENDERBUFFER, GL.GL_DEPTH_COMPONENT32F, width, height)
    GL.glFramebufferRenderbuffer(
        GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, GL.GL_RENDERBUFFER, buffer
    )
    return buffer
