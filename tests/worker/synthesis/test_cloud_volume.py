"""Clouds against the law of Beer and Lambert, and against integrals written down."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.feasibility import obstacles
from api_schemas.members import Texture
from api_schemas.requests import TextureRequest
from worker.synthesis import synthesize, synthesize_volume

GREY = {"technique": "constant", "value": 0.4}
NOISE = {"technique": "perlin", "frequency": 2}


def pixels(size=(16, 12), **fields):
    body = {"technique": "cloud_volume", **fields}
    return synthesize(TypeAdapter(Texture).validate_python(body), size, None).pixels


@pytest.mark.parametrize("steps", [1, 7, 64])
@pytest.mark.parametrize("extinction", [0.0, 0.5, 3.0, 40.0])
def test_t44_a_constant_density_lets_through_what_beer_and_lambert_say(extinction, steps):
    opacity = pixels(density=GREY, extinction=extinction, steps=steps, show="opacity")

    assert 1 - opacity == pytest.approx(np.exp(-0.4 * extinction), abs=1e-6)


def test_opacity_is_one_less_the_exponential_of_the_integral():
    opacity = pixels(density=NOISE, extinction=2.5, steps=10, show="opacity")[..., 0]

    voxels = synthesize_volume(TypeAdapter(Texture).validate_python(NOISE), (16, 12, 10)).voxels
    assert opacity == pytest.approx(1 - np.exp(-2.5 * voxels[..., 0].mean(axis=0)), abs=1e-6)


def test_a_cloud_in_one_light_shows_its_colour_as_far_as_it_is_opaque():
    cloud = pixels(density=NOISE, shade=0.0, lit=[0.5, 2.0, 0.25], steps=9)

    # Premultiplied: without shadows every bit of opacity has the same colour
    assert cloud[..., :3] == pytest.approx(cloud[..., 3:] * np.array([0.5, 2.0, 0.25]), abs=1e-6)


def test_a_constant_density_is_shaded_by_as_much_of_it_as_is_in_reach():
    options = {"shade": 5.0, "reach": 0.25, "lit": [1.0] * 3, "dark": [0.0] * 3}

    cloud = pixels(size=(4, 16), density=GREY, **options)

    # Four rows above, and half of the pixel's own
    expected = np.exp(-5 * 0.4 * 4.5 / 16)
    assert cloud[..., 0] / cloud[..., 3] == pytest.approx(expected, abs=1e-6)


def test_shadows_fall_downwards():
    half = {
        "technique": "checkerboard",
        "cells": [1, 2, 1],
        "colors": [[0.0] * 3, [1.0] * 3],
    }
    cloud = pixels(size=(2, 32), density=half, reach=0.5, steps=2)

    light = cloud[:16, 0, 0]
    # The upper half is cloud: darker the deeper below its top
    assert (np.diff(light) < 0).all()
    assert (cloud[16:] == 0).all()


def test_what_lies_below_no_density_is_clear():
    assert (pixels(density={"technique": "constant", "value": -1.0}) == 0).all()


def test_a_flat_density_is_refused_at_its_place():
    body = {
        "texture": {
            "technique": "cloud_volume",
            "density": {"technique": "levels", "input": {"technique": "gray_scott"}},
        }
    }

    (found,) = obstacles(TextureRequest.model_validate(body))

    assert (found.code, found.pointer) == ("texture_not_solid", "/texture/density/input")


def test_the_tile_repeats():
    cloud = pixels(size=(96, 96), density=NOISE, steps=12)

    for axis in (0, 1):
        seam = abs(np.take(cloud, 0, axis) - np.take(cloud, -1, axis)).max()
        assert seam <= 1.3 * abs(np.diff(cloud, axis=axis)).max()
