"""T38, material-id maps: a picture says which surface is where."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio

pytestmark = pytest.mark.gl

RED = {"technique": "unlit", "color": [3.0, 0.0, 0.0]}
GREEN = {"technique": "phong", "diffuse_weight": 0.0, "emission": [0.0, 2.0, 0.0]}
BLUE = {"technique": "metallic_roughness", "base_color": [0.0] * 3, "emission": [0.0, 0.0, 1.0]}
GLASS = {"technique": "unlit", "color": [1.0, 1.0, 1.0], "alpha_mode": "blend", "opacity": 0.25}
SIZE = 32


def poster(studio: Studio, *names: str, lights: list[Any] | None = None, **node: Any) -> Any:
    """Draw a square that fills the picture, uv = the pixel's place."""
    scene = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}},
        "lights": lights or [],
        "nodes": [{"mesh": {"type": "plane"}, **node}],
    }
    return studio.layers(scene, names, (SIZE, SIZE))


def blocks(codes: Any) -> Pixels:
    """Blow a small picture up to the size of the poster."""
    return np.kron(np.array(codes), np.ones((SIZE // len(codes), SIZE // len(codes[0]))))


CODES = [[0, 1, 2, 0], [2, 2, 1, 0], [0, 0, 0, 1], [1, 2, 0, 2]]


def among(studio: Studio, *surfaces: dict[str, Any], codes: Any = CODES, **how: Any) -> Any:
    texture = studio.texture(np.array(codes, dtype=np.float64) / 255)
    return {"texture": texture, "surfaces": list(surfaces), **how}


def test_t38_the_codes_of_a_picture_choose_the_surface(studio: Studio) -> None:
    drawn = poster(studio, surface_map=among(studio, RED, GREEN, BLUE))["picture"]

    chosen = blocks(CODES).astype(int)
    lights = np.array([[3.0, 0, 0, 1], [0, 2.0, 0, 1], [0, 0, 1.0, 1]])
    np.testing.assert_allclose(drawn, lights[chosen], atol=1e-6)


def test_t38_a_map_of_one_surface_is_that_surface(studio: Studio) -> None:
    lamp = [{"type": "directional", "direction": [0.2, 0.1, -1.0], "shadow": {}}]
    shiny = {"technique": "phong", "specular_weight": 0.5}
    plain = poster(studio, surface=shiny, lights=lamp)["picture"]

    mapped = poster(studio, surface_map=among(studio, shiny), lights=lamp)["picture"]
    constant = among(studio, RED, shiny, codes=[[1]])

    assert mapped.tobytes() == plain.tobytes()
    assert poster(studio, surface_map=constant, lights=lamp)["picture"].tobytes() == plain.tobytes()


def test_numbers_are_rounded_and_bounded(studio: Studio) -> None:
    codes = [[-3.0, 0.4], [0.6, 300.0]]
    bad = among(studio, RED, GREEN, BLUE, codes=codes)
    drawn = poster(studio, surface_map=bad)["picture"]

    assert drawn[0, 0, 0] == drawn[0, -1, 0] == 3
    assert drawn[-1, 0, 1] == 2
    assert drawn[-1, -1, 2] == 1


def test_what_is_no_number_is_the_first_surface(studio: Studio) -> None:
    bad = among(studio, RED, GREEN, codes=[[np.nan, np.inf], [-np.inf, 1.0]])
    drawn = poster(studio, surface_map=bad)["picture"]

    assert drawn[0, 0, 0] == drawn[-1, 0, 0] == 3
    assert drawn[0, -1, 1] == drawn[-1, -1, 1] == 2


def test_every_mode_of_opacity_may_stand_beside_the_others(studio: Studio) -> None:
    holes = RED | {"alpha_mode": "mask", "opacity": 0.2}
    drawn = poster(studio, surface_map=among(studio, GLASS, GREEN, holes))["picture"]

    chosen = blocks(CODES).astype(int)
    lights = np.array([[0.25, 0.25, 0.25, 0.25], [0, 2.0, 0, 1], [0, 0, 0, 0]])
    np.testing.assert_allclose(drawn, lights[chosen], atol=1e-6)


def test_it_is_one_thing_of_several_materials(studio: Studio) -> None:
    layers = poster(studio, "object_id", "material_id", surface_map=among(studio, RED, GREEN, BLUE))

    assert (layers["object_id"] == 1).all()
    np.testing.assert_array_equal(layers["material_id"][..., 0], blocks(CODES) + 1)


def test_its_holes_let_light_through(studio: Studio) -> None:
    """A square of which a quarter is cut away hangs before a wall in light along the view."""
    holes = RED | {"alpha_mode": "mask", "opacity": 0.0}
    scene = {
        "camera": {
            "type": "orthographic",
            "height": 4.0,
            "pose": {"eye": [0.0, 0.0, 0.4], "target": [0.0, 0.0, 0.0]},
        },
        "lights": [{"type": "directional", "direction": [0, 0, -1], "shadow": {"radius": 0}}],
        "nodes": [
            {"mesh": {"type": "plane", "width": 4, "height": 4}},
            {
                "mesh": {"type": "plane"},
                "transform": {"translation": [0, 0, 1]},
                "surface_map": among(studio, GREEN, holes, codes=[[0, 0], [1, 0]]),
            },
        ],
    }
    wall = studio.draw(scene, (SIZE, SIZE))[..., 0] > 0.4

    lit = np.ones((SIZE, SIZE), bool)
    lit[SIZE // 4 : 3 * SIZE // 4, SIZE // 4 : 3 * SIZE // 4] = False
    lit[SIZE // 2 : 3 * SIZE // 4, SIZE // 4 : SIZE // 2] = True
    np.testing.assert_array_equal(wall, lit)


def test_what_casts_no_shadow_hides_no_light(studio: Studio) -> None:
    lamp = [{"type": "directional", "direction": [0, 0, -1], "shadow": {}}]

    def wall(**node: Any) -> Pixels:
        hung = {"mesh": {"type": "plane"}, "transform": {"translation": [0, 0, 2.5]}, **node}
        scene = {
            "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0, 0, 2]}},
            "lights": lamp,
            "nodes": [{"mesh": {"type": "plane"}}, hung],
        }
        return studio.draw(scene, (SIZE, SIZE))[4:-4, 4:-4, 0]

    assert (wall() == 0).all()
    assert (wall(casts_shadows=False) > 0.7).all()
