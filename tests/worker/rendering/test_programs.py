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


def test_the_programs_used_last_are_kept(studio: Studio) -> None:
    from worker.rendering.programs import (  # noqa: PLC0415  needs OpenGL
        PROGRAMS_MAX,
        Program,
        ProgramCache,
    )

    studio.poster({"technique": "unlit"})
    cache = ProgramCache(Program)
    sources = (Source(VERTEX, ("v",)), Source(FRAGMENT, ("f",)))
    first = cache.get("first", lambda: sources)
    for number in range(PROGRAMS_MAX + 1):
        cache.get(number, lambda: sources)
        assert cache.get("first", lambda: sources) is first
    assert len(cache) == PROGRAMS_MAX + 2  # a scene that is being drawn loses none

    cache.trim()

    assert len(cache) == PROGRAMS_MAX
    assert cache.get("first", lambda: sources) is first
    second = cache.get(0, lambda: sources)
    assert not second.drawn
    cache.delete()


def test_scenes_of_ever_other_maps_do_not_pile_programs_up(studio: Studio) -> None:
    from worker.rendering.programs import PROGRAMS_MAX  # noqa: PLC0415  needs OpenGL
    from worker.rendering.renderer import _engine  # noqa: PLC0415  needs OpenGL

    texture = studio.texture([[0.5]])
    wraps = ("repeat", "mirror", "clamp", "border")
    for number in range(PROGRAMS_MAX + 6):
        wrap = [wraps[number % 4], wraps[number // 4 % 4]]
        name = ("color", "weight")[number % 2]
        term = ("ambient", "diffuse", "specular")[number // 16 % 3]
        filter_name = "nearest" if number < 48 else "bilinear"
        mapped = {"texture": texture, "wrap": wrap, "filter": filter_name}
        studio.poster({"technique": "phong", f"{term}_{name}": mapped})

    assert len(_engine().renderer._programs) <= PROGRAMS_MAX
