import pytest

from api_schemas.textures.prefiltered_environment import PrefilteredEnvironmentSpec
from tests.worker.rendering.studio import Studio


@pytest.fixture
def studio() -> Studio:
    # Where there is no OpenGL this import fails; tests marked gl were skipped before that.
    from worker.rendering.renderer import render  # noqa: PLC0415

    return Studio(render)


@pytest.fixture
def small_cubes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blurred skies of few texels, for tests that do not look at them closely."""
    monkeypatch.setattr(PrefilteredEnvironmentSpec, "cube_side", 16)
