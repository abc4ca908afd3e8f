"""Wood: rings round a heart where nothing disturbs them (T19), averaged over pixels."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.synthesis import synthesize, synthesize_volume
from worker.synthesis.wood import _ring, wood_at


def spec(**fields):
    return TypeAdapter(Texture).validate_python({"technique": "wood", **fields})


def test_t19_undisturbed_rings_are_parts_of_the_distance_from_the_heart():
    pixels = synthesize(spec(rings=3, strength=0.0, heart=[0.25, 0.75]), (600, 600), None).pixels

    u = (np.arange(600) + 0.5) / 600
    radius = 3 * np.hypot(u - 0.25, (1 - u - 0.75)[:, np.newaxis])
    part = radius % 1
    # Away from the edges the mean of a straight rise is its middle
    inside = (part > 0.01) & (part < 0.99)
    assert pixels[..., 0][inside] == pytest.approx(part[inside], abs=1e-6)


@pytest.mark.parametrize(("trunk", "axis"), [("u", 2), ("v", 1), ("w", 0)])
def test_t19_a_solid_trunk_is_the_same_all_along(trunk, axis):
    cube = synthesize_volume(spec(rings=4, strength=0.0, trunk=trunk), (12, 12, 12)).voxels[..., 0]

    assert (cube == np.take(cube, [0], axis)).all()
    assert cube.std() > 0.1


def test_the_mean_over_a_width_is_the_integral_of_the_sawtooth():
    def integral(x):
        return np.floor(x) / 2 + (x % 1) ** 2 / 2

    for x in np.linspace(-2, 2, 101):
        for width in (0.05, 0.3, 0.9, 1.0):
            mean = (integral(x + width / 2) - integral(x - width / 2)) / width
            assert _ring(x, width) == pytest.approx(mean, abs=1e-12)


def test_noise_moves_rings_by_its_strength():
    body = {"rings": 5.0, "strength": 0.4, "rest": 0.5}
    moved = spec(**body, noise={"technique": "constant", "value": 1.0})

    pixels = synthesize(moved, (40, 40), None).pixels[..., 0]

    u = (np.arange(40) + 0.5) / 40
    places = np.stack(np.meshgrid(u, u[::-1], [0.0], indexing="xy"), axis=-1).reshape(-1, 3)
    assert pixels.ravel() == pytest.approx(wood_at(moved, places, np.ones(1600), 1 / 40), abs=1e-6)
    still = wood_at(moved, places, np.full(1600, 0.5), 0.0)
    assert wood_at(moved, places, np.ones(1600), 0.0) == pytest.approx((still + 0.2) % 1, abs=1e-9)


def test_rings_finer_than_the_pixels_are_their_mean():
    assert synthesize(spec(rings=64.0), (32, 32), None).pixels == pytest.approx(0.5, abs=1e-6)
