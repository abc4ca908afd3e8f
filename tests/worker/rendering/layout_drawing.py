"""Layouts' chunks drawn point for point, into a float framebuffer with one pixel for each."""

import numpy as np

from api_schemas.families import LayoutSpec
from worker.rendering.calls import call_of
from worker.rendering.chunks import chunk, join
from worker.rendering.gl_context import GL, check, floats
from worker.rendering.programs import Program
from worker.rendering.renderer import fingerprint
from worker.rendering.targets import Target


def drawn(spec: LayoutSpec, directions: np.ndarray, changes: np.ndarray) -> np.ndarray:
    """Return places and their changes, (n, 4), of directions (n, 3) that change so."""
    fingerprint()  # opens the context
    call = call_of("layout", "layouts", spec)
    fragment = "\n".join(
        [
            "#version 410 core",
            f'#include "{call.chunk}"',
            *call.declarations(0),
            "uniform sampler2D directions;",
            "out vec4 color;",
            "void main() {",
            "    ivec2 at = ivec2(gl_FragCoord.xy);",
            "    vec3 place = texelFetch(directions, ivec2(at.x, 0), 0).xyz;",
            "    vec3 across = texelFetch(directions, ivec2(at.x, 1), 0).xyz;",
            f"    Footprint found = {call.text('Reach(place, across, vec3(0.0))', 0)};",
            "    color = vec4(found.place, found.across_x);",
            "}",
        ]
    )
    program = Program.link(
        join(chunk("whole_target.vert"), "whole_target.vert"), join(fragment, "layout")
    )
    count = len(directions)
    target = Target.create(count, 1, attachments=1, depth=False)
    texture, arrays = int(GL.glGenTextures(1)), int(GL.glGenVertexArrays(1))
    try:
        GL.glActiveTexture(GL.GL_TEXTURE0)
        GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
        GL.glBindSampler(0, 0)
        rows = floats(np.concatenate([directions, changes]))
        GL.glTexImage2D(
            GL.GL_TEXTURE_2D, 0, GL.GL_RGB32F, count, 2, 0, GL.GL_RGB, GL.GL_FLOAT, rows
        )
        for side in (GL.GL_TEXTURE_MIN_FILTER, GL.GL_TEXTURE_MAG_FILTER):
            GL.glTexParameteri(GL.GL_TEXTURE_2D, side, GL.GL_NEAREST)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, target.framebuffer)
        GL.glViewport(0, 0, count, 1)
        for state in (GL.GL_DEPTH_TEST, GL.GL_CULL_FACE, GL.GL_BLEND):
            GL.glDisable(state)
        program.bind()
        program.set("directions", 0)
        for name, value in call.values(spec, 0).items():
            program.set(name, value)
        GL.glBindVertexArray(arrays)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        check("drawing a layout")
        return np.asarray(target.read(0, count, 1)[0], dtype=np.float64)
    finally:
        GL.glBindVertexArray(0)
        GL.glDeleteVertexArrays(1, [arrays])
        GL.glDeleteTextures([texture])
        target.delete()
        program.delete()
