"""All maps of a material grown at once: the same pixels of each, normals turned with them."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.feasibility import obstacles
from api_schemas.requests import TextureRequest
from tests.growing import grow, noise, sources, upload

GROWING = (
    "ashikhmin",
    "efros_leung",
    "graph_cut",
    "image_quilting",
    "retargeting",
    "texture_optimization",
    "wei_levoy",
)
PART = np.pad(np.ones((8, 6, 1), np.float32), ((9, 7), (4, 10), (0, 0)))
MENDED = {
    "hole_filling": {"hole": PART},
    "image_shuffling": {"region": PART, "shift": [7, -3], "margin": 2},
}
SMALL = {"efros_leung": {"window": 5}, "graph_cut": {"block": 12}, "image_quilting": {"block": 12}}


def normals_of(relief):
    slopes = [-np.gradient(relief, axis=1), np.gradient(relief, axis=0), np.ones(relief.shape)]
    normals = np.stack(slopes, axis=-1)
    return (normals / np.linalg.norm(normals, axis=-1, keepdims=True)).astype(np.float32)


@pytest.mark.parametrize("technique", GROWING)
def test_all_maps_are_copied_from_the_same_places(technique):
    exemplar, height, normal = noise(24, 20), noise(24, 20, 1, 1), noise(24, 20, 3, 2)
    fields = {"height": height, "normal": normal, "roughness": noise(24, 20, 1, 3)}

    made = grow(technique, exemplar, (30, 26), **fields, **SMALL.get(technique, {}))

    place = sources(made, exemplar)
    for name, whole in fields.items():
        assert made.layers[name].pixels.tobytes() == whole[place].tobytes()
    assert made.image.pixels.tobytes() == exemplar[place].tobytes()
    assert "occlusion" not in made.layers


@pytest.mark.parametrize("technique", MENDED)
def test_all_maps_are_mended_from_the_same_places(technique):
    exemplar, height, normal = noise(24, 20), noise(24, 20, 1, 1), noise(24, 20, 3, 2)
    fields = {"height": height, "normal": normal, "occlusion": noise(24, 20, 1, 3)}

    made = grow(technique, exemplar, (20, 24), **fields, **MENDED[technique])

    place = sources(made, exemplar)
    assert (np.array(place) != np.indices((24, 20))).any(axis=0)[PART[..., 0] > 0].all()
    for name, whole in fields.items():
        assert made.layers[name].pixels.tobytes() == whole[place].tobytes()
    assert made.image.pixels.tobytes() == exemplar[place].tobytes()
    assert "roughness" not in made.layers


@pytest.mark.parametrize("technique", ["graph_cut", "image_quilting"])
@pytest.mark.parametrize("normal_range", ["unit", "signed"])
def test_normals_are_those_of_the_relief_that_came_out(technique, normal_range):
    # Smooth, and the same in no direction
    rows, columns = np.indices((60, 60)) / 6
    relief = np.sin(columns + 0.4 * np.cos(rows)) + 0.5 * np.sin(2.3 * rows + 0.2 * columns)
    normal = normals_of(relief)
    exemplar = ((relief - relief.min()) / np.ptp(relief)).astype(np.float32)[..., np.newaxis]
    given = normal if normal_range == "signed" else (normal + 1) / 2

    made = grow(
        technique, exemplar, (80, 80), block=24, turns=True, flips=True, tolerance=8,
        height=relief[..., np.newaxis], normal=given, normal_range=normal_range,
    )  # fmt: skip

    found = made.layers["normal"].pixels
    found = found if normal_range == "signed" else 2 * found - 1
    views = made.layers["turn"].pixels[..., 0]
    assert len(np.unique(views)) >= 4
    grown = normals_of(made.layers["height"].pixels[..., 0].astype(np.float64))
    # Within squares, where the neighbours a slope is made of are those of the exemplar
    rows, columns = sources(made, exemplar)
    inside = np.zeros(rows.shape, bool)
    inside[1:-1, 1:-1] = True
    for down, right in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        away = np.abs(np.roll(rows, (down, right), (0, 1)) - rows)
        away += np.abs(np.roll(columns, (down, right), (0, 1)) - columns)
        inside &= (away == 1) & (np.roll(views, (down, right), (0, 1)) == views)
        inside &= (rows > 0) & (rows < 59) & (columns > 0) & (columns < 59)
    assert inside.mean() > 0.4
    assert found[inside] == pytest.approx(grown[inside], abs=1e-5)


def test_a_layer_of_a_map_that_was_not_given_is_refused():
    texture = {"technique": "graph_cut", "exemplar": upload(0), "height": upload(1)}
    body = {"texture": texture, "output": {"layers": ["height", "normal"], "format": "exr"}}
    request = TypeAdapter(TextureRequest).validate_python(body)

    found = [(obstacle.code, obstacle.pointer) for obstacle in obstacles(request)]

    assert ("layer_unknown", "/output/layers/1") in found
    assert ("layer_unknown", "/output/layers/0") not in found
