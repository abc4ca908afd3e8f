"""Shapes of glass: which of their sides is seen through which."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from api_schemas import meshes
from tests.worker.rendering.panes import BLUE, CAMERA, GREEN, RED, glass, over
from tests.worker.rendering.studio import Studio
from worker.geometry import primitives
from worker.geometry.mesh import Mesh

pytestmark = pytest.mark.gl


SHAPES: dict[str, meshes.Mesh] = {
    "sphere": meshes.Sphere(type="sphere", segments=32, rings=16),
    "sphere, sorted": meshes.Sphere(type="sphere", segments=300, rings=150),
    "box": meshes.Box(type="box", width=1.2, height=0.8, depth=3.0),
    "can": meshes.Cylinder(type="cylinder", caps=True, height=1.0),
    "tube": meshes.Cylinder(type="cylinder", height=1.0),
}


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("turn", [[0, 0, 0, 1], [0.3, -0.5, 0.2, 0.7], [1, 0, 0, 0], [0, 1, 1, 0]])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_closed_shape_shows_its_inner_back_through_its_front(
    studio: Studio, name: str, turn: list[float], mirror: float
) -> None:
    shape = primitives.build(SHAPES[name])
    inside_out = replace(shape, triangles=shape.triangles[:, ::-1].copy(), normals=-shape.normals)

    def drawn(mesh: Mesh, **surface: Any) -> np.ndarray:
        lights = [
            {"type": "directional", "direction": [-1.0, -0.4, -0.3], "color": RED},
            {"type": "directional", "direction": [1.0, 0.7, -0.2], "color": GREEN},
        ]
        node = {
            "mesh": studio.mesh(mesh),
            "transform": {"rotation": turn, "scale": [0.5 * mirror, 0.5, 0.5]},
            "surface": {"technique": "phong", **surface},
        }
        return studio.draw({"camera": CAMERA, "lights": lights, "nodes": [node]}, (48, 48))

    both = drawn(shape, alpha_mode="blend", opacity=0.5)
    front_only = drawn(shape, alpha_mode="blend", opacity=0.5, double_sided=False)

    front = drawn(shape, double_sided=False)
    back = drawn(inside_out, double_sided=False)
    np.testing.assert_allclose(front_only, 0.5 * front, atol=1e-6)
    wrong = np.abs(both - over(0.5 * front, 0.5 * back)).max(axis=2) > 1e-5
    # Sorted triangles are exact where they are small against their distance: not at the outline.
    assert wrong.sum() <= (3 if "sorted" in name else 0)


def test_a_ring_is_seen_four_times_through_itself(studio: Studio) -> None:
    ring = {"type": "torus", "segments": 256, "rings": 128}
    node = {
        "mesh": ring,
        "transform": {"scale": [0.6, 0.6, 0.6]},
        "surface": glass([1.0, 1.0, 1.0], 0.5),
    }

    drawn = studio.draw({"camera": CAMERA, "nodes": [node]}, (64, 64))

    # Seen from the side, a ray through its middle enters and leaves the tube twice.
    assert drawn[32, 32, 3] == pytest.approx(1 - 0.5**4, abs=1e-6)


def test_the_sides_of_a_ring_come_from_back_to_front(studio: Studio) -> None:
    # Green where x is beyond zero, else blue; seen along x from either end.
    halves = studio.texture(np.array([[GREEN, BLUE, BLUE, GREEN]]))
    surface = glass({"texture": halves, "filter": "nearest"})
    ring = {"type": "torus", "segments": 256, "rings": 128}

    def middle(turn: float) -> np.ndarray:
        transform = {"rotation": [0.0, turn, 0.0, 1.0], "scale": [0.6, 0.6, 0.6]}
        node = {"mesh": ring, "transform": transform, "surface": surface}
        return studio.draw({"camera": CAMERA, "nodes": [node]}, (65, 65))[32, 32]

    # Two sides of the near half hide three quarters of those of the far half.
    assert middle(-1.0) == pytest.approx([0.0, 0.75, 0.1875, 0.9375], abs=1e-5)
    assert middle(1.0) == pytest.approx([0.0, 0.1875, 0.75, 0.9375], abs=1e-5)
