"""T38, shadow mapping: what is lit and what is not lies where the rays of the light say.

A square of side 2 floats one unit over a floor, seen from straight above by an orthographic camera.
A point (x, 1, z) of it throws its shadow to L + (P - L) h / (h - 1) from a light L at height h.
"""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio

pytestmark = pytest.mark.gl

SIZE = 240
EXTENT = 12.0  # of the picture, in the world
MATT = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]}
SUN = {"type": "directional", "direction": [3.0, -1.0, 0.5]}
POINT = {"type": "point", "position": [-4.0, 2.5, 0.5], "intensity": 10.0}
SPOT = {
    "type": "spot",
    "position": [-4.0, 2.5, 0.5],
    "direction": [4.0, -1.5, -0.5],
    "intensity": 10.0,
    "inner_angle": 0.9,
    "outer_angle": 1.0,
}
WIDE = SPOT | {"inner_angle": 1.4, "outer_angle": 1.5}
LIGHTS = {"sun": SUN, "point": POINT, "spot": SPOT, "wide spot": WIDE}


def place(height: float) -> dict[str, Any]:
    return {"translation": [0.0, height, 0.0]}


def scene(light: dict[str, Any], surface: dict[str, Any] = MATT) -> dict[str, Any]:
    """The floor and what floats over it."""
    return {
        "camera": {
            "type": "orthographic",
            "height": EXTENT,
            "pose": {"eye": [0.0, 9.0, 0.0], "target": [0.0, 0.0, 0.0], "up": [0.0, 0.0, -1.0]},
        },
        "lights": [light],
        "nodes": [
            {
                "mesh": {"type": "plane", "facing": "+y", "width": 14, "height": 14},
                "surface": MATT,
            },
            {
                "mesh": {"type": "plane", "facing": "+y"},
                "transform": place(1.0),
                "surface": surface,
            },
        ],
    }


def visibility(studio: Studio, light: dict[str, Any], surface: dict[str, Any] = MATT) -> Pixels:
    """What share of a light arrives: with shadows over without; NaN where there is none at all."""
    shadow = {"bias": 0.1, "radius": 0} | light.pop("shadow", {})
    plain = studio.draw(scene(light, surface), (SIZE, SIZE))[..., 0]
    shaded = studio.draw(scene(light | {"shadow": shadow}, surface), (SIZE, SIZE))[..., 0]
    return np.where(plain > 1e-3, shaded / np.maximum(plain, 1e-30), np.nan)


def grid() -> tuple[Pixels, Pixels]:
    """x and z of every pixel on the floor."""
    along = ((np.arange(SIZE) + 0.5) / SIZE - 0.5) * EXTENT
    return np.meshgrid(along, along)


def thrown(light: dict[str, Any], x: float, z: float) -> tuple[float, float]:
    """Where (x, 1, z) throws its shadow on the floor."""
    if light["type"] == "directional":
        dx, dy, dz = light["direction"]
        return x - dx / dy, z - dz / dy
    lx, ly, lz = light["position"]
    return lx + (x - lx) * ly / (ly - 1), lz + (z - lz) * ly / (ly - 1)


def distance_to_edge(light: dict[str, Any]) -> Pixels:
    """How far inside the square's shadow each pixel lies; negative outside."""
    x, z = grid()
    (left, top), (right, bottom) = thrown(light, -1, -1), thrown(light, 1, 1)
    return np.minimum.reduce([x - left, right - x, z - top, bottom - z])


@pytest.mark.parametrize("name", LIGHTS)
def test_t38_the_shadow_lies_where_the_rays_say(studio: Studio, name: str) -> None:
    """A texel reaches at most 14 sqrt(2) / 1000 across the rays, three times that on the floor
    (they are as steep as 1 : 3), and the edge is rounded to one texel, faded over two and moved by
    a tenth: 2 x 0.06. Of lights nearby texels are larger in the corners."""
    light = dict(LIGHTS[name])
    seen = visibility(studio, light)
    inside = distance_to_edge(light)
    x, z = grid()
    floor = (np.maximum(abs(x), abs(z)) > 1) & ~np.isnan(seen)

    assert (seen[floor & (inside > 0.15)] == 0).all()
    assert (seen[floor & (inside < -0.15)] == 1).all()
    assert (floor & (inside > 0.15)).sum() > 1000
    assert (floor & (inside < -0.15)).sum() > 10000
    # The edge itself: the middle of the step, on average over its length.
    shadowed = np.nansum(np.where(floor, 1 - seen, 0)) * (EXTENT / SIZE) ** 2
    expected = (floor & (inside > 0)).sum() * (EXTENT / SIZE) ** 2
    assert shadowed == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("name", LIGHTS)
def test_the_square_itself_is_lit(studio: Studio, name: str) -> None:
    seen = visibility(studio, dict(LIGHTS[name]))
    x, z = grid()
    square = (np.maximum(abs(x), abs(z)) < 0.97) & ~np.isnan(seen)

    assert square.sum() > 1000
    assert (seen[square] == 1).all()


@pytest.mark.parametrize("mode", ["mask", "blend"])
@pytest.mark.parametrize("name", ["sun", "point"])
def test_t38_holes_let_light_through(studio: Studio, name: str, mode: str) -> None:
    quarters = studio.texture([[1.0, 0.3], [0.3, 1.0]])
    holed = MATT | {"alpha_mode": mode, "opacity": {"texture": quarters, "filter": "nearest"}}
    light = dict(LIGHTS[name])
    seen = visibility(studio, light, holed)
    x, z = grid()
    inside = distance_to_edge(light)
    middle_x, middle_z = thrown(light, 0, 0)
    away = np.minimum(abs(x - middle_x), abs(z - middle_z)) > 0.15
    sure = away & (inside > 0.15) & (np.maximum(abs(x), abs(z)) > 1)
    # Row 0 is the far side, -z: its first column is opaque.
    opaque = (x < middle_x) == (z < middle_z)

    assert (seen[sure & opaque] == 0).all()
    assert (seen[sure & ~opaque] == 1).all()
    assert (sure & opaque).sum() > 200


@pytest.mark.parametrize("radius", [0, 1, 4])
def test_the_edge_fades_over_as_many_texels_as_its_radius_says(studio: Studio, radius: int) -> None:
    """Straight down, a texel of a 64 map is 14 / (64 - 2 (2 + radius)) wide on the floor."""
    light = {"type": "directional", "direction": [0.0, -1.0, 0.0]}
    surface = MATT | {"alpha_mode": "mask", "opacity": 1.0}
    tall = scene(light, surface)
    tall["camera"]["pose"]["up"] = [0.0, 0.0, -1.0]
    tall["nodes"][1]["transform"] = {"translation": [0.0, 1.0, 0.0], "scale": [3.0, 1.0, 3.0]}
    # The eye looks from below the square, so that all of its shadow shows.
    tall["camera"]["pose"]["eye"] = [0.0, 0.9, 0.0]
    tall["lights"][0]["shadow"] = {"resolution": 64, "radius": radius, "bias": 0.1}
    row = studio.draw(tall, (SIZE, SIZE))[SIZE // 2, :, 0]
    texel = 14 / (64 - 2 * (2 + radius)) / (EXTENT / SIZE)  # in pixels

    faded = ((row > 1e-6) & (row < 1 - 1e-6)).sum() / 2  # two edges
    assert (2 * radius + 0.9) * texel - 1 <= faded <= (2 * radius + 2) * texel + 1
    edge = np.abs(row - 0.5).argmin()
    assert abs(abs((edge + 0.5) / SIZE - 0.5) * EXTENT - 3) <= texel * EXTENT / SIZE


@pytest.mark.parametrize("name", LIGHTS)
@pytest.mark.parametrize("mesh", ["sphere", "torus"])
def test_smooth_things_do_not_stripe_themselves(studio: Studio, name: str, mesh: str) -> None:
    """With the default bias, and where the light does not graze."""
    light = dict(LIGHTS[name])
    alone = scene(light)
    alone["nodes"] = [{"mesh": {"type": mesh}, "surface": MATT}]
    if mesh == "torus":  # its tube turned to the light, so that it does not shade itself
        alone["nodes"][0]["transform"] = {"scale": [1.0, 0.02, 1.0]}
    plain = studio.draw(alone, (SIZE, SIZE))[..., 0]
    alone["lights"] = [light | {"shadow": {}}]
    shaded = studio.draw(alone, (SIZE, SIZE))[..., 0]
    bright = plain > 0.3 * plain.max()

    assert bright.sum() > 300
    np.testing.assert_allclose(shaded[bright], plain[bright], rtol=1e-6)


def test_lights_of_every_kind_share_one_array(studio: Studio) -> None:
    """Light adds up: the picture of all is the sum of the pictures of each."""
    lights = [
        SUN | {"shadow": {"resolution": 300}},
        {"type": "ambient", "radiance": [0.2, 0.2, 0.2]},
        POINT | {"shadow": {"resolution": 128, "radius": 2}},
        POINT | {"position": [3.0, 4.0, 3.0]},
        WIDE | {"shadow": {"resolution": 512}},
        SPOT | {"shadow": {"resolution": 64, "radius": 8}},
    ]
    together = scene(lights[0])
    together["lights"] = lights

    drawn = studio.draw(together, (SIZE, SIZE))[..., 0]

    each = [studio.draw(scene(light), (SIZE, SIZE))[..., 0] for light in lights]
    np.testing.assert_allclose(drawn, np.sum(each, axis=0), rtol=1e-5, atol=1e-5)


def test_32_points_with_shadows_fit(studio: Studio) -> None:
    crowd = scene(POINT)
    crowd["lights"] = [
        POINT
        | {
            "position": [-4.0 - 0.03 * number, 2.5, 0.5],
            "shadow": {"resolution": 128, "radius": 0},
        }
        for number in range(32)
    ]
    drawn = studio.draw(crowd, (SIZE, SIZE))[..., 0]

    assert np.isfinite(drawn).all()
    assert drawn[SIZE // 2, int((3.0 / EXTENT + 0.5) * SIZE)] == 0  # behind the square for all


def test_a_scene_without_shadows_compiles_nothing_for_them(studio: Studio) -> None:
    from worker.rendering.renderer import _engine  # noqa: PLC0415  needs OpenGL

    def programs() -> int:
        return len(_engine().renderer._programs)

    studio.draw(scene(SUN), (8, 8))
    unlit = {"technique": "unlit"}
    studio.poster(unlit)
    before = programs()
    studio.draw(scene(SUN | {"shadow": {}}), (8, 8))
    assert programs() <= before + 1

    before = programs()
    studio.draw(scene(POINT), (8, 8))
    studio.poster(unlit, lights=[POINT | {"shadow": {}}])
    assert programs() == before


def test_an_empty_scene_has_no_shadows(studio: Studio) -> None:
    empty = scene(SUN | {"shadow": {}})
    empty["lights"].append(POINT | {"shadow": {}})
    empty["nodes"] = []

    assert not studio.draw(empty, (8, 8)).any()


def test_shadows_do_not_end_where_a_tile_does(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    from worker.rendering import renderer  # noqa: PLC0415  needs OpenGL

    lit = scene(SUN | {"shadow": {"resolution": 256}})
    lit["lights"].append(POINT | {"shadow": {"resolution": 256}})
    whole = studio.draw(lit, (SIZE, SIZE))
    monkeypatch.setattr(renderer, "tile_size", lambda *picture: (64, 64))

    cut = studio.draw(lit, (SIZE, SIZE))

    # As in test_renderer: positions are rounded anew, and an edge may turn a texel.
    assert (np.abs(cut - whole).max(axis=2) > 1e-4).mean() < 0.005


@pytest.mark.parametrize("unlit", [False, True])
def test_the_light_that_reaches_a_point_is_a_layer(studio: Studio, unlit: bool) -> None:
    """Without a shadow 1, in it 0; of two lamps each counts by its irradiance on the point."""
    surface = {"technique": "unlit"} if unlit else MATT
    other = {"type": "directional", "direction": [0.0, -1.0, 0.0], "irradiance": 3.0}
    away = {"type": "directional", "direction": [0.0, 1.0, 0.0], "irradiance": 4.0}
    lit = scene(SUN | {"shadow": {"radius": 0, "bias": 0.1}}, surface)
    lit["nodes"][0]["surface"] = surface
    lit["lights"] += [other, away, {"type": "ambient"}]
    layers = studio.layers(lit, ["light_visibility", "tangent"], (SIZE, SIZE))
    seen, inside = layers["light_visibility"][..., 0], distance_to_edge(SUN)
    x, z = grid()
    floor = np.maximum(abs(x), abs(z)) > 1

    np.testing.assert_allclose(seen[floor & (inside > 0.15)], 3 / 8, atol=1e-6)
    np.testing.assert_allclose(seen[floor & (inside < -0.15)], 4 / 8, atol=1e-6)
    lit["lights"] = []
    assert not studio.layers(lit, ["light_visibility"], (SIZE, SIZE))["light_visibility"].any()
