"""Textures that fill space, as volumes and as formulas at the fragment."""

from typing import Any

import numpy as np
import pytest

from api_schemas.language import FAMILIES
from tests.worker.rendering.coded import ORTHOGRAPHIC, pixel_middles, shown
from tests.worker.rendering.studio import Studio
from worker.images.volume import Volume
from worker.rendering.texture_maker import TextureMaker
from worker.synthesis import synthesize

pytestmark = pytest.mark.gl

BALL = {"type": "sphere", "segments": 256, "rings": 128}
PLANE = {"type": "plane", "width": 2.0, "height": 2.0}
PERLIN = {"technique": "perlin", "frequency": 4, "octaves": 1, "seed": 5}
CUBES = {"technique": "checkerboard", "cells": [4, 4], "colors": [[1, 1, 1], [0, 0, 0]]}
IN_TILE = {"matrix": [[0.4, 0, 0], [0, 0.4, 0], [0, 0, 0.4]], "offset": [0.5, 0.5, 0.5]}
"""Brings -1..1 within the tile."""
THIRD = [0.0, 0.5, 0.0, 0.8660254037844386]  # a turn by 60 degrees round y
FILTERS = ["nearest", "bilinear", "trilinear", "anisotropic", "formula"]


def carved(texture: Any, filter_name: str = "bilinear", **more: Any) -> dict[str, Any]:
    coordinates = {"technique": "position", **IN_TILE, **more.pop("coordinates", {})}
    return {"texture": texture, "coordinates": coordinates, "filter": filter_name, **more}


class LinearStudio(Studio):
    """One in which every volume is x, y, z at the middles of 16 x 8 x 32 voxels."""

    @property
    def maker(self) -> TextureMaker:
        def volume(_spec: Any, meaning: Any) -> Volume:
            x, y, z = ((np.arange(n) + 0.5) / n for n in (16, 8, 32))
            w, v, u = np.meshgrid(z, y[::-1], x, indexing="ij")
            return Volume(np.stack([u, v, w], axis=-1).astype(np.float32), meaning)

        return TextureMaker(self.make, volume, super().maker.closed_form)


def test_t19_trilinear_reproduces_a_linear_function() -> None:
    from worker.rendering.renderer import render  # noqa: PLC0415  needs OpenGL

    studio = LinearStudio(render)
    turned = {"rotation": [0.2, 0.5, 0.1, 0.8]}
    # Another seed, lest a later test finds this volume kept
    drawn = shown(studio, PLANE, carved({**PERLIN, "seed": 999}), 64, transform=turned)
    matrix = [[0.1, 0.3, 0.05], [-0.2, 0.1, 0.2], [0.1, -0.1, 0.3]]
    placed = shown(
        studio,
        PLANE,
        carved(
            {**PERLIN, "seed": 999},
            coordinates={"matrix": matrix, "frame": "world", "offset": [0.5, 0.5, 0.5]},
        ),
        64,
    )

    seen = drawn[..., 3] > 0
    assert seen.mean() > 0.3
    # A plane has z = 0 in its own frame
    np.testing.assert_allclose(drawn[seen][:, 2], 0.5, atol=1e-6)
    x, y = pixel_middles(64)
    wanted = 0.5 + np.stack([x, y, 0 * x], axis=-1) @ np.array(matrix).T
    np.testing.assert_allclose(placed[..., :3], wanted, atol=2e-6)


@pytest.mark.parametrize("filter_name", FILTERS)
def test_t19_a_carving_turns_with_its_thing(studio: Studio, filter_name: str) -> None:
    # Turning mesh and eye together leaves the picture as it is
    color = carved(PERLIN, filter_name)
    box = {"type": "box", "width": 1.0, "height": 1.0, "depth": 1.0}
    eye = np.array([2.0, 1.5, 3.0])
    turn = np.array([[0.5, 0, 0.8660254], [0, 1, 0], [-0.8660254, 0, 0.5]])

    still = shown(studio, box, color, camera={**ORTHOGRAPHIC, "pose": {"eye": eye.tolist()}})
    turned = shown(
        studio,
        box,
        color,
        camera={**ORTHOGRAPHIC, "pose": {"eye": (turn @ eye).tolist()}},
        transform={"rotation": THIRD},
    )

    error = np.abs(still - turned).max(axis=2)
    assert np.quantile(error, 0.95) < 1e-5
    assert (error > 0.02).mean() < 0.02  # voxels and pixels at edges fall to either side
    assert still[still[..., 3] > 0][:, 0].std() > 0.05


@pytest.mark.parametrize("filter_name", FILTERS)
def test_t03_a_constant_solid_is_constant(studio: Studio, filter_name: str) -> None:
    drawn = shown(
        studio, BALL, carved({"technique": "constant", "value": [0.3, 0.6, 0.1]}, filter_name)
    )

    seen = drawn[drawn[..., 3] > 0][:, :3]
    np.testing.assert_array_equal(seen, np.broadcast_to(np.float32([0.3, 0.6, 0.1]), seen.shape))


def test_t19_a_formula_is_its_volume_where_that_is_fine_enough(studio: Studio) -> None:
    # 32 voxels a cell: what lies between two neighbours is off by 1/8 h^2 f'' < .002
    volume, formula = (
        shown(studio, BALL, carved(PERLIN, name)) for name in ("bilinear", "formula")
    )

    # At the rim a pixel reaches over whole cells, which the formula blurs
    middle = np.hypot(*pixel_middles(64)) < 0.7
    assert np.abs(volume - formula)[middle].max() < 0.01
    assert volume[middle][:, 0].std() > 0.05


def test_x25_a_checkerboard_is_averaged_over_each_pixel(studio: Studio) -> None:
    # As the picture of as many pixels is, which is exact (tested where it is made)
    board = {"technique": "checkerboard", "cells": [7, 5]}
    spec = FAMILIES["textures"]["checkerboard"].model_validate(board)

    drawn = studio.poster(
        {"technique": "unlit", "color": {"texture": board, "filter": "formula"}}, (64, 64)
    )

    expected = synthesize(spec, (64, 64), lambda *_: pytest.fail("nothing to load")).pixels
    np.testing.assert_allclose(drawn[..., :3], expected[..., :3], atol=2e-5)


def test_cubes_of_two_colours_are_cut_by_the_ball(studio: Studio) -> None:
    drawn = shown(studio, BALL, carved(CUBES, "formula"), 128)

    x, y = pixel_middles(128)
    out = np.sqrt(np.maximum(0, 1 - x * x - y * y))
    cells = [np.floor(4 * (0.5 + 0.4 * axis)) for axis in (x, y, out)]
    white = sum(cells) % 2 == 0
    inside = np.hypot(x, y) < 0.95
    assert (np.abs(drawn[..., 0] - white)[inside] < 0.02).mean() > 0.8  # others are at edges
    assert (np.abs(drawn[..., 0] - white)[inside] < 0.6).mean() > 0.98


def test_a_transform_moves_a_formula_as_it_moves_a_picture(studio: Studio) -> None:
    moved = {"transform": {"scale": [2.0, 1.0], "rotation": 0.3, "offset": [0.1, -0.2]}}
    texture = {"technique": "gardner", "seed": 3}

    pictures = [
        studio.poster(
            {"technique": "unlit", "color": {"texture": texture, "filter": name, **moved}},
            (256, 256),
        )
        for name in ("bilinear", "formula")
    ]

    assert np.abs(pictures[0] - pictures[1]).max() < 0.02
    assert pictures[0][..., 0].std() > 0.05


def test_a_ramp_of_noise_is_a_formula_of_a_formula(studio: Studio) -> None:
    stops = [{"position": 0.2, "color": [0, 0, 1]}, {"position": 0.8, "color": [1, 1, 0]}]
    marble = {"technique": "ramp", "input": PERLIN, "stops": stops}

    volume, formula = (
        shown(studio, BALL, carved(marble, name)) for name in ("bilinear", "formula")
    )

    middle = np.hypot(*pixel_middles(64)) < 0.7
    assert np.abs(volume - formula)[middle].max() < 0.03


def test_equal_formulas_share_a_program_and_numbers_make_no_new_one(studio: Studio) -> None:
    shown(studio, PLANE, carved({**CUBES, "cells": [3, 3]}, "formula"))
    shown(studio, PLANE, carved({**CUBES, "cells": [5, 2]}, "formula"))

    assert studio.facts["jit_ms"] < 1.0


def test_seeds_are_other_volumes(studio: Studio) -> None:
    first, second = (shown(studio, BALL, carved({**PERLIN, "seed": seed})) for seed in (1, 2))

    assert np.abs(first - second).max() > 0.1


class StripedStudio(Studio):
    """One in which every volume is stripes across x, 8 voxels from one to the next."""

    @property
    def maker(self) -> TextureMaker:
        def volume(_spec: Any, meaning: Any) -> Volume:
            wave = 0.5 + 0.5 * np.cos(2 * np.pi * np.arange(64) / 8)
            voxels = np.broadcast_to(wave[None, None, :, None], (64, 64, 64, 1))
            return Volume(np.ascontiguousarray(voxels, dtype=np.float32), meaning)

        return TextureMaker(self.make, volume, super().maker.closed_form)


@pytest.mark.parametrize("filter_name", ["trilinear", "anisotropic"])
def test_stripes_stay_sharp_along_a_plane_that_leans_away(filter_name: str) -> None:
    from worker.rendering.renderer import render  # noqa: PLC0415  needs OpenGL

    studio = StripedStudio(render)
    # A pixel is one voxel wide and eight deep: sin 82.8 degrees of a turn round x
    half = np.arccos(1 / 8) / 2
    color = carved(
        {**PERLIN, "seed": 998},
        filter_name,
        coordinates={"matrix": [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.5]]},
    )
    plane = {"type": "plane", "width": 2.0, "height": 16.0}

    drawn = shown(
        studio,
        plane,
        color,
        64,
        transform={"rotation": [float(np.sin(half)), 0.0, 0.0, float(np.cos(half))]},
    )

    row = drawn[32, :, 0]
    contrast = row.max() - row.min()
    # One voxel's blur leaves sin(pi / 8) / (pi / 8) = .97, that of eight nothing
    if filter_name == "anisotropic":
        assert contrast > 0.8
    else:
        assert contrast < 0.2
