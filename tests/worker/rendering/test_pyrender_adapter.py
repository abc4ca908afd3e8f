import inspect
from importlib.metadata import version

import pytest

pytestmark = pytest.mark.gl

HOOKS = (
    "_update_context",
    "_configure_forward_pass_viewport",
    "_get_camera_matrices",
    "_sorted_mesh_nodes",
    "_get_primitive_program",
    "_bind_lighting",
    "_bind_and_draw_primitive",
    "_read_main_framebuffer",
    "delete",
)


@pytest.mark.parametrize("name", HOOKS)
def test_pyrender_has_the_hooks_we_override(name: str) -> None:
    from worker.rendering.pyrender_adapter import FloatRenderer  # noqa: PLC0415  needs OpenGL

    stock = getattr(FloatRenderer.__base__, name)
    ours = getattr(FloatRenderer, name)

    assert ours is not stock
    assert list(inspect.signature(ours).parameters) == list(inspect.signature(stock).parameters)


def test_every_override_is_a_hook() -> None:
    from worker.rendering.pyrender_adapter import FloatRenderer  # noqa: PLC0415  needs OpenGL

    overridden = {
        name
        for name, value in vars(FloatRenderer).items()
        if inspect.isfunction(value) and hasattr(FloatRenderer.__base__, name)
    }

    assert overridden - {"__init__"} == set(HOOKS)


def test_pyrenders_traversal_calls_the_hooks() -> None:
    from worker.rendering.pyrender_adapter import FloatRenderer  # noqa: PLC0415  needs OpenGL

    stock = FloatRenderer.__base__
    called = inspect.getsource(stock.render) + inspect.getsource(stock._forward_pass)

    assert [name for name in HOOKS[:-1] if f"self.{name}(" not in called] == []


def test_the_pinned_version_is_installed() -> None:
    assert version("pyrender-maintained") == "1.0.1"
