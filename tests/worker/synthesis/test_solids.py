"""Solid textures against points, closed forms and their own slices (T19, T47)."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.families import TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from worker.synthesis import synthesize, synthesize_volume
from worker.synthesis._perlin_points import noise3
from worker.synthesis._permutation import permutation

SOLIDS = sorted(name for name, spec in FAMILIES["textures"].items() if spec.solid)
GREY = [{"position": 0.0, "color": [0.0] * 3}, {"position": 1.0, "color": [1.0] * 3}]
PERLIN = {"technique": "perlin", "frequency": 3, "gradients": "reference", "range": "signed"}


def spec(body):
    return TypeAdapter(Texture).validate_python(body)


def voxels(body, size):
    return synthesize_volume(spec(body), size).voxels


def test_the_first_octave_is_the_noise_of_2002():
    cube = voxels(PERLIN | {"frequency": 4}, (24, 20, 18))[..., 0]

    table = permutation(0)
    for s, r, c in np.random.default_rng(0).integers(0, (13, 20, 18), (300, 3)):
        # The last cells along each axis join the tile's ends
        x, y, z = (c + 0.5) / 6, (19.5 - r) / 5, (s + 0.5) / 4.5
        if max(x, y, z) < 3:
            assert cube[s, r, c] == pytest.approx(noise3(x, y, z, table), abs=1e-6)


def test_a_picture_is_the_slice_at_zero_of_its_solid():
    body = PERLIN | {"octaves": 3, "frequency": 4, "gain": 0.7}
    depth = 512

    picture = synthesize(spec(body), (64, 64), None).pixels
    # The first slice lies 1/1024 of a tile deep; slopes along w are below 2 * 16 cells
    first = voxels(body, (64, 64, depth))[0]

    assert first == pytest.approx(picture, abs=32 / 1024)


def test_a_solid_repeats_along_every_axis():
    body = PERLIN | {"frequency": 5, "octaves": 2, "seed": 3}

    cube = voxels(body, (40, 30, 20))[..., 0]

    for axis in range(3):
        seam = abs(np.take(cube, 0, axis) - np.take(cube, -1, axis)).max()
        assert seam <= 1.2 * abs(np.diff(cube, axis=axis)).max()


def test_noise_in_space_stays_below_its_supremum():
    cube = voxels(PERLIN | {"frequency": 16}, (96, 96, 96))

    # 1.03635381121 (T47); std .270 over random points
    assert abs(cube).max() <= 1.0364
    assert cube.std() == pytest.approx(0.27, abs=0.01)


def test_a_solid_checkerboard_is_cubes_averaged_over_each_voxel():
    body = {"technique": "checkerboard", "cells": [2, 4, 6], "colors": [[1.0] * 3, [0.0] * 3]}

    fine = voxels(body, (8, 8, 12))[..., 0]
    coarse = voxels(body, (1, 4, 1))[..., 0]

    s, r, c = np.indices(fine.shape)
    assert (fine == (c // 4 + (7 - r) // 2 + s // 2 + 1) % 2).all()
    assert coarse == pytest.approx(0.5)


def test_pointwise_textures_see_each_voxel_alone():
    body = {
        "technique": "mix",
        "a": {"technique": "ramp", "input": PERLIN, "stops": GREY},
        "b": {"technique": "levels", "input": {"technique": "constant", "value": 0.25}},
        "amount": PERLIN,
    }

    found = voxels(body, (12, 10, 8))

    noise = voxels(PERLIN, (12, 10, 8)).clip(0, 1)
    assert found == pytest.approx(np.repeat(noise * (1 - noise) + 0.25 * noise, 3, -1), abs=1e-6)


def test_equal_nested_solids_are_made_once():
    steps = []
    body = {"technique": "mix", "a": PERLIN, "b": PERLIN, "amount": 0.5}

    synthesize_volume(spec(body), (4, 4, 4), report=lambda share, step: steps.append((share, step)))

    assert [step for _, step in steps] == ["perlin", "mix"]
    assert [share for share, _ in steps] == [0.0, 0.5]


@pytest.mark.parametrize("name", SOLIDS)
def test_every_solid_technique_can_make_a_volume(name):
    fields = FAMILIES["textures"][name].model_fields
    body = {"technique": name}
    for field, info in fields.items():
        if info.is_required() and field != "technique":
            body[field] = {"value": 0.5, "stops": GREY}.get(field, PERLIN)

    made = synthesize_volume(spec(body), (6, 5, 4))

    assert made.voxels.shape[:3] == (4, 5, 6)
    assert np.isfinite(made.voxels).all()
    assert made.meaning == synthesize(spec(body), (6, 5), None).meaning


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    body = PERLIN | {"octaves": 2}

    one = with_threads(1, lambda: voxels(body, (40, 30, 20)))
    two = with_threads(2, lambda: voxels(body, (40, 30, 20)))

    assert one.tobytes() == two.tobytes()


def test_no_technique_is_solid_by_chance():
    assert not TextureSpec.solid
    assert {"perlin", "checkerboard", "constant", "ramp", "mix", "levels"} <= set(SOLIDS)
