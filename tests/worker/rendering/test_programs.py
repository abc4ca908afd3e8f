import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from worker.errors import RenderError
from worker.rendering.chunks import Source

pytestmark = pytest.mark.gl

VERTEX = "#version 410 core\nvoid main() { gl_Position = vec4(0.0); }\n"
FRAGMENT = """#version 410 core
uniform vec3 used;
uniform float forgotten;
uniform mat3 several[2];
uniform int whole;
out vec4 color;
void main() { color = vec4(several[whole] * used, 1.0) + several[1 - whole][0].xyzz; }
"""


@pytest.fixture
def program(studio: Studio):
    from worker.rendering.programs import Program  # noqa: PLC0415  needs OpenGL

    studio.poster({"technique": "unlit"})  # opens the context
    made = Program.link(Source(VERTEX, ("v",)), Source(FRAGMENT, ("f",)))
    made.bind()
    yield made
    made.delete()


def test_declared_uniforms_are_set(program) -> None:
    from worker.rendering.gl_context import GL  # noqa: PLC0415  needs OpenGL

    program.set("used", (1, 2, 3))
    program.set("several", np.arange(18).reshape(2, 3, 3))
    program.set("whole", 1)

    value = np.zeros(9, dtype=np.float32)
    GL.glGetUniformfv(program.number, program.uniforms["several"].location, value)
    np.testing.assert_array_equal(value.reshape(3, 3).T, np.arange(9).reshape(3, 3))


def test_a_misspelt_uniform_is_an_error(program) -> None:
    with pytest.raises(KeyError, match="usde"):
        program.set("usde", (1, 2, 3))


def test_a_uniform_that_the_compiler_dropped_is_not(program) -> None:
    assert program.uniforms["forgotten"].location is None

    program.set("forgotten", 1.0)


@pytest.mark.parametrize(
    ("name", "value"),
    [("used", (1.0, 2.0)), ("used", np.ones((2, 3))), ("several", np.ones(10)), ("whole", [1, 2])],
)
def test_a_wrong_shape_is_an_error(program, name: str, value: object) -> None:
    with pytest.raises(ValueError, match=name):
        program.set(name, value)


def test_a_compilers_message_names_the_chunks(studio: Studio) -> None:
    from worker.rendering.programs import Program  # noqa: PLC0415  needs OpenGL

    studio.poster({"technique": "unlit"})
    broken = FRAGMENT.replace("void main", "#line 7 1\nvoid mian")

    with pytest.raises(RenderError, match=r"0 = main, 1 = surfaces/x\.glsl"):
        Program.link(Source(VERTEX, ("v",)), Source(broken + "oops", ("main", "surfaces/x.glsl")))
