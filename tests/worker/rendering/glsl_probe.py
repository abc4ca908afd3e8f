"""Evaluates GLSL in one pixel."""

import numpy as np
from numpy.typing import NDArray


def evaluate(chunk_name: str, expression: str, before: str = "") -> NDArray[np.float32]:
    """Return the four numbers of a vec4 expression that speaks of a chunk's functions.

    OpenGL must be open: a studio has drawn something.
    """
    from worker.rendering.chunks import chunk, join  # noqa: PLC0415
    from worker.rendering.gl_context import GL, check  # noqa: PLC0415  needs OpenGL
    from worker.rendering.programs import Program  # noqa: PLC0415
    from worker.rendering.targets import Target  # noqa: PLC0415

    text = (
        f'#version 410 core\n#include "{chunk_name}"\nlayout(location = 0) out vec4 found;\n'
        f"void main() {{ {before} found = {expression}; }}\n"
    )
    vertex = join(chunk("whole_target.vert"), "whole_target.vert")
    program = Program.link(vertex, join(text, "probe"))
    target = Target.create(1, 1, attachments=1, depth=False)
    array = int(GL.glGenVertexArrays(1))
    GL.glDisable(GL.GL_DEPTH_TEST)
    GL.glDisable(GL.GL_CULL_FACE)
    GL.glDisable(GL.GL_BLEND)
    GL.glViewport(0, 0, 1, 1)
    GL.glBindVertexArray(array)
    program.bind()
    GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
    GL.glBindVertexArray(0)
    found = target.read(0, 1, 1)[0, 0]
    check("probing")
    target.delete()
    program.delete()
    GL.glDeleteVertexArrays(1, [array])
    return found
