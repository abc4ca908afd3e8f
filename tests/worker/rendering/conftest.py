import pytest

from tests.worker.rendering.studio import Studio


@pytest.fixture
def studio() -> Studio:
    # Where there is no OpenGL this import fails; tests marked gl were skipped before that.
    from worker.rendering.renderer import render  # noqa: PLC0415

    return Studio(render)
