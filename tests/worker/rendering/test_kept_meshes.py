"""Meshes are kept from picture to picture, and never shown in each other's place."""

from typing import Any

import numpy as np
import pytest

from api_schemas.model_mesh import ModelMesh
from tests.worker.rendering.studio import Studio
from worker.geometry.plane import plane
from worker.models.model import Model, Part

pytestmark = pytest.mark.gl

CAMERA = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 10.0]}}
WHITE = {"technique": "unlit"}


def covered(studio: Studio, **mesh: Any) -> float:
    node = {"mesh": {"type": "model", "asset": "0" * 64, **mesh}, "surface": WHITE}
    drawn = studio.draw({"camera": CAMERA, "nodes": [node]}, (32, 32))
    return float(drawn[..., 3].mean())


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ({"scene": 0}, {"scene": 1}),
        ({"files": {"a": "1" * 64}}, {"files": {"a": "2" * 64}}),
        (
            {"files": {"a": "1" * 64, "b": "2" * 64}},
            {"files": {f"a {'1' * 64} b": "2" * 64}},
        ),
    ],
)
def test_a_file_is_another_model_in_each_scene_and_beside_other_files(
    one: dict[str, Any], other: dict[str, Any]
) -> None:
    """A glTF file may give one mesh other morph weights in each of its scenes."""
    from worker.rendering.renderer import render  # noqa: PLC0415  needs OpenGL

    def read(mesh: ModelMesh) -> Model:
        side = 1.0 if mesh.model_dump(exclude_unset=True).items() >= one.items() else 2.0
        part = Part(plane(side, side, "+z"), np.eye(4), None, None, "0")
        return Model((part,), (), (), (), (), {}, ())

    def render_models(scene: Any, output: Any, maker: Any, _reader: Any, report: Any) -> Any:
        return render(scene, output, maker, read, report)

    studio = Studio(render_models)

    assert covered(studio, **one) == pytest.approx(0.25)
    assert covered(studio, **other) == pytest.approx(1.0)
    assert covered(studio, **one) == pytest.approx(0.25)
