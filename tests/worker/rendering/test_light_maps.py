"""T38, light maps: baked light on a second set of coordinates."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from worker.geometry.mesh import Mesh

pytestmark = pytest.mark.gl

LIT = ["phong", "metallic_roughness", "brushed_metal", "ward", "ashikhmin_shirley"]
LAMP = {"type": "directional", "direction": [0.3, -0.2, -1.0]}


def sheet(studio: Studio) -> dict[str, Any]:
    """A square of side 2 whose second set of coordinates is the first one turned by a half."""
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    uv = (corners[:, :2] + 1) / 2
    return studio.mesh(
        Mesh(
            positions=corners,
            normals=np.tile([0.0, 0, 1], (4, 1)),
            uv_sets=(uv, 1 - uv),
            triangles=np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32),
        )
    )


def draw(studio: Studio, surface: dict[str, Any], *lights: dict[str, Any]) -> Any:
    scene = {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}},
        "lights": list(lights),
        "nodes": [{"mesh": sheet(studio), "surface": surface}],
    }
    return studio.draw(scene, (16, 16))[..., :3]


@pytest.mark.parametrize("technique", LIT)
def test_t38_a_black_light_map_changes_nothing(studio: Studio, technique: str) -> None:
    black = {"texture": studio.texture([[[0.0, 0.0, 0.0]]])}
    plain = draw(studio, {"technique": technique}, LAMP)

    mapped = draw(studio, {"technique": technique, "light_map": black}, LAMP)

    np.testing.assert_allclose(mapped, plain, rtol=1e-6)


@pytest.mark.parametrize("technique", LIT)
def test_t38_a_constant_light_map_is_ambient_light(studio: Studio, technique: str) -> None:
    light = [0.25, 0.5, 2.0]
    baked = {"texture": studio.texture([[light]])}

    mapped = draw(studio, {"technique": technique, "light_map": baked}, LAMP)

    ambient = {"type": "ambient", "radiance": light}
    np.testing.assert_allclose(mapped, draw(studio, {"technique": technique}, LAMP, ambient), 1e-6)


def test_t38_a_light_map_is_read_by_the_second_set(studio: Studio) -> None:
    """L = ka Ca La, with La of the texel that the second coordinates find."""
    picture = np.random.default_rng(1).random((4, 4, 3))
    surface = {"technique": "phong", "diffuse_color": [0.5, 1.0, 0.25]}
    baked = {"texture": studio.texture(picture), "filter": "nearest"}

    drawn = draw(studio, surface | {"light_map": baked})
    first = baked | {"coordinates": {"technique": "uv"}}
    turned = draw(studio, surface | {"light_map": first})

    texels = np.kron(picture, np.ones((4, 4, 1))) * [0.5, 1.0, 0.25]
    np.testing.assert_allclose(drawn, texels[::-1, ::-1], rtol=1e-5)
    np.testing.assert_allclose(turned, texels, rtol=1e-5)


def test_what_shines_by_itself_needs_no_light_map(studio: Studio) -> None:
    baked = {"texture": studio.texture([[[1.0, 1.0, 1.0]]])}
    plain = draw(studio, {"technique": "unlit", "color": [0.5, 0.5, 0.5]})

    mapped = draw(studio, {"technique": "unlit", "color": [0.5, 0.5, 0.5], "light_map": baked})

    assert mapped.tobytes() == plain.tobytes()
