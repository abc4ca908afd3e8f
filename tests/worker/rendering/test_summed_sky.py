"""Light of an environment added up direction by direction (T09), against closed forms and sums."""

from typing import Any

import numpy as np
import pytest

from api_schemas.layouts.latlong import LatlongSpec
from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import CHALK, latlong
from tests.worker.rendering.test_anisotropic_highlights import NORMAL, seen, unit
from tests.worker.rendering.test_streaks_of_sky import ABOVE, BRUSHED, LIGHT, SOLID, TOWARDS, VIEWS

pytestmark = [pytest.mark.gl, pytest.mark.usefixtures("small_cubes")]


def summed(studio: Studio, light: Any, **more: Any) -> dict[str, Any]:
    return {"texture": studio.texture(light), "gathered": "sum", "visible": False, **more}


def test_t09_chalk_in_an_even_light_is_that_light(studio: Studio) -> None:
    sky = summed(studio, np.ones((64, 128)))

    # A thousand directions are even to a few in ten thousand.
    np.testing.assert_allclose(seen(studio, CHALK, NORMAL, environment=sky), 1, atol=1e-3)


@pytest.mark.parametrize(("turn", "irradiance"), [(0.0, 2 * np.pi / 3), (np.pi / 2, 2 / 3)])
def test_t09_a_clamped_cosine_has_the_irradiance_of_its_closed_form(
    studio: Studio, turn: float, irradiance: float
) -> None:
    # L = max(0, w.z) on a square that faces z, or that it is turned away from by a right angle
    sky = summed(studio, np.maximum(latlong(256)[..., 2], 0), rotation_y=turn)

    shown = seen(studio, CHALK, NORMAL, environment=sky)

    np.testing.assert_allclose(shown, irradiance / np.pi, atol=1e-3)


@pytest.mark.parametrize("name", BRUSHED)
def test_t09_every_formula_is_its_own_integral(studio: Studio, name: str) -> None:
    surface, reflects = BRUSHED[name]
    # Not the light of other tests: blurred skies are kept by content, and these are small.
    sky = summed(studio, 1.5 * LIGHT)

    for view in VIEWS:
        weight = reflects(view, TOWARDS) * TOWARDS[:, 2] * SOLID
        expected = (weight * 1.5 * LIGHT[ABOVE]).sum()
        shown = seen(studio, surface, view, environment=sky)
        # Cells are 6 degrees wide, lobes 20 and more.
        assert shown[1] == pytest.approx(expected, rel=0.01)


def test_lamps_and_other_surfaces_stay_as_they_are(studio: Studio) -> None:
    light = np.ones((32, 64)) * 0.5
    lamp = {"type": "directional", "direction": [0.0, 0.3, -1.0]}
    dark = summed(studio, np.zeros((32, 64)))
    plain = seen(studio, CHALK, NORMAL, lights=[lamp])

    np.testing.assert_allclose(seen(studio, CHALK, NORMAL, lights=[lamp], environment=dark), plain)
    for technique in ("phong", "glass", "brushed_metal", "unlit"):
        looked_up = summed(studio, light, gathered="prefiltered")
        added = seen(studio, {"technique": technique}, NORMAL, environment=summed(studio, light))
        as_ever = seen(studio, {"technique": technique}, NORMAL, environment=looked_up)
        np.testing.assert_array_equal(added, as_ever)


def test_no_light_is_lost_in_cells() -> None:
    from worker.rendering.sky_lamps import lamps_of  # noqa: PLC0415  beside the renderer

    random = np.random.default_rng(3)
    pixels = random.random((128, 256, 3)).astype(np.float32)
    pixels[5, 7] = np.nan
    rows = np.pi * (0.5 - (np.arange(129)) / 128)
    solid = (np.sin(rows[:-1]) - np.sin(rows[1:])) * 2 * np.pi / 256
    directions, power = lamps_of(pixels, LatlongSpec(technique="latlong"))

    assert len(directions) == 1536
    expected = (np.nan_to_num(pixels).astype(np.float64) * solid[:, None, None]).sum(axis=(0, 1))
    np.testing.assert_allclose(power.sum(axis=0), expected, rtol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1, rtol=1e-12)


def test_a_single_bright_texel_is_one_lamp_in_its_direction() -> None:
    from worker.rendering.sky_lamps import lamps_of  # noqa: PLC0415  beside the renderer

    towards = latlong(256)
    pixels = np.zeros((128, 256, 1), np.float32)
    pixels[40, 100] = 7.0
    directions, power = lamps_of(pixels, LatlongSpec(technique="latlong"))

    lit = power[:, 0] > 0
    assert np.count_nonzero(lit) == 1
    assert directions[lit][0] @ unit(towards[40, 100]) > np.cos(1e-3)
