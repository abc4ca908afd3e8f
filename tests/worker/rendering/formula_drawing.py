"""Closed forms drawn point for point, into a float framebuffer with one pixel for each."""

import numpy as np

from worker.closed_form import ClosedForm
from worker.rendering.chunks import chunk, join
from worker.rendering.closed_forms import formula
from worker.rendering.gl_context import GL, check, floats
from worker.rendering.programs import Program
from worker.rendering.renderer import _engine
from worker.rendering.targets import Target


def drawn(form: ClosedForm, places: np.ndarray, steps: np.ndarray) -> np.ndarray:
    """Evaluate a form, (n, 4), at places (n, 3) with steps (2, 3) to the neighbouring pixels."""
    _engine().context.check_thread()
    found = formula(form, "texture")
    fragment = "\n".join(
        [
            "#version 410 core",
            *(f'#include "{name}"' for name in found.chunks),
            *found.declarations,
            "uniform sampler2D places;",
            "uniform vec3 steps[2];",
            "out vec4 color;",
            "void main() {",
            "    vec3 place = texelFetch(places, ivec2(gl_FragCoord.xy), 0).xyz;",
            "    vec3 across_x = steps[0], across_y = steps[1];",
            f"    color = {found.call};",
            "}",
        ]
    )
    program = Program.link(
        join(chunk("whole_target.vert"), "whole_target.vert"), join(fragment, "formula")
    )
    target = Target.create(len(places), 1, attachments=1, depth=False)
    texture = int(GL.glGenTextures(1))
    arrays = int(GL.glGenVertexArrays(1))
    try:
        GL.glActiveTexture(GL.GL_TEXTURE0)
        GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
        GL.glBindSampler(0, 0)
        GL.glTexImage2D(
            GL.GL_TEXTURE_2D,
            0,
            GL.GL_RGB32F,
            len(places),
            1,
            0,
            GL.GL_RGB,
            GL.GL_FLOAT,
            floats(places),
        )
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_NEAREST)
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MAG_FILTER, GL.GL_NEAREST)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, target.framebuffer)
        GL.glViewport(0, 0, len(places), 1)
        for state in (GL.GL_DEPTH_TEST, GL.GL_CULL_FACE, GL.GL_BLEND):
            GL.glDisable(state)
        program.bind()
        program.set("places", 0)
        program.set("steps", steps)
        for name, value in found.uniforms.items():
            program.set(name, value)
        GL.glBindVertexArray(arrays)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        check("drawing a formula")
        return target.read(0, len(places), 1)[0]
    finally:
        GL.glBindVertexArray(0)
        GL.glDeleteVertexArrays(1, [arrays])
        GL.glDeleteTextures([texture])
        target.delete()
        program.delete()
