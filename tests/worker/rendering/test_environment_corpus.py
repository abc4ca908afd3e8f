"""Environments of others: ILM's, Debevec's, and what Mitsuba and published tables make of them."""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import CHALK, MIRROR, ball, ball_normals
from tests.worker.synthesis.spheres import run
from worker.images import image_io
from worker.images.image import Image
from worker.synthesis._harmonics import NAMES, irradiance

pytestmark = [pytest.mark.corpus]

TABLE_SCALE = 0.1002  # of the published coefficients of the Uffizi, by 5_reference/sh/HOW_TO_USE


def picture(path: Path) -> Image:
    return image_io.read(path, "linear", "colour")


def texture(studio: Studio, path: Path) -> dict[str, Any]:
    return studio.texture(np.ascontiguousarray(picture(path).pixels[..., :3]))


def uffizi_table(corpus: Path) -> np.ndarray:
    with (corpus / "5_reference/sh/irradiance_sh9_table.csv").open() as file:
        rows = {
            row["coefficient"]: [float(row[c]) for c in "RGB"]
            for row in csv.DictReader(file)
            if row["environment"] == "Uffizi Gallery"
        }
    # The table's frame is (x, y, -z) of the picture whose middle is -x.
    flipped = [-1 if name in ("L10", "L2-1", "L21") else 1 for name in NAMES]
    return np.array([rows[name] for name in NAMES]) * np.array(flipped)[:, None] / TABLE_SCALE


@pytest.mark.parametrize(
    "name", ["probulator/uffizi.hdr", "probulator/grace.hdr", "oiio/uffizi_latlong_env-128.exr"]
)
def test_t36_probes_stand_upright_and_are_told_when_they_do_not(corpus: Path, name: str) -> None:
    upright = picture(corpus / "2_envmaps" / name)
    turned = Image(upright.pixels[::-1].copy(), "colour")

    told = [run({"technique": "irradiance"}, (4, 2), image).report for image in (upright, turned)]

    assert [report["upside_down"] for report in told] == [False, True]


def test_t36_the_uffizis_coefficients_are_the_published_ones(corpus: Path) -> None:
    image = picture(corpus / "2_envmaps/probulator/uffizi.hdr")
    spec = {"technique": "irradiance", "layout": {"technique": "latlong", "centre": "-x"}}

    report = run(spec, (4, 2), image).report

    found = np.array([report["coefficients"][name] for name in NAMES])
    table = uffizi_table(corpus)
    assert np.linalg.norm(found - table) < 0.01 * np.linalg.norm(table)


@pytest.mark.gl
def test_t36_a_chalk_ball_in_the_uffizi_is_the_tables_and_mitsubas(
    studio: Studio, corpus: Path
) -> None:
    environment = texture(studio, corpus / "2_envmaps/probulator/uffizi.hdr")
    path = corpus / "5_reference/mitsuba_renders/mitsuba_uffizi_diffuse1.exr"
    reference = picture(path).pixels[..., :3].astype(np.float64)
    side = reference.shape[0]
    normals, on_it = ball_normals(side)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.97

    seen = ball(studio, {"texture": environment}, CHALK, side)[on_it][:, :3]
    smooth = ball(studio, {"texture": environment, "matt": "harmonics"}, CHALK, side)[on_it][:, :3]

    # Mitsuba's picture is of 8192 samples a pixel: its noise is part of the difference.
    mean = reference[on_it].mean()
    assert np.sqrt(((seen - reference[on_it]) ** 2).mean()) < 0.01 * mean
    assert np.abs(seen - reference[on_it]).max() < 0.03 * reference[on_it].max()
    # In the frame of the picture whose middle is -x, +z of the world is -x, and +x is -z.
    x, y, z = normals[on_it].T
    table = irradiance(uffizi_table(corpus), np.stack([-z, y, x], axis=1)) / math.pi
    assert np.abs(smooth - table).max() < 0.03 * table.max()


@pytest.mark.gl
def test_t07_a_mirror_ball_in_the_uffizi_is_mitsubas(studio: Studio, corpus: Path) -> None:
    environment = texture(studio, corpus / "2_envmaps/probulator/uffizi.hdr")
    path = corpus / "5_reference/mitsuba_renders/mitsuba_uffizi_mirror.exr"
    reference = picture(path).pixels[..., :3].astype(np.float64)
    side = reference.shape[0]
    normals, on_it = ball_normals(side)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.9

    seen = ball(studio, {"texture": environment}, MIRROR, side, supersampling=4)

    error = seen[on_it][:, :3] - reference[on_it]
    assert np.sqrt((error**2).mean()) < 0.05 * reference[on_it].std()


def test_t08_the_angular_probe_is_openimageios_latlong(corpus: Path) -> None:
    probe = picture(corpus / "2_envmaps/oiio/uffizi_probe-128.exr")
    reference = picture(corpus / "2_envmaps/oiio/uffizi_latlong_env-128.exr").pixels[..., :3]
    size = (reference.shape[1], reference.shape[0])
    spec = {"technique": "convert_layout", "layout": {"technique": "angular_probe"}}

    best = min(
        np.sqrt(((made - reference) ** 2).mean())
        for centre in ("-z", "+z")
        for middle in ("+z", "+x", "-z", "-x")
        for made in [
            run(
                {
                    **spec,
                    "layout": {"technique": "angular_probe", "centre": centre},
                    "to": {"technique": "latlong", "centre": middle},
                },
                size,
                probe,
            ).image.pixels
        ]
    )

    assert best < 0.03 * reference.mean()


def test_t20_ilms_cube_and_latlong_are_the_same_sphere(corpus: Path) -> None:
    flat = picture(corpus / "2_envmaps/openexr/WavyLinesLatLong.exr")
    cube = picture(corpus / "2_envmaps/openexr/WavyLinesCube.exr")
    size = (256, 128)

    of_flat = run({"technique": "convert_layout"}, size, flat).image.pixels
    of_cube = run(
        {"technique": "convert_layout", "layout": {"technique": "cube"}}, size, cube
    ).image.pixels

    # Lines of three texels, sampled twice by others: what is left are their edges.
    assert np.corrcoef(of_flat.ravel(), of_cube.ravel())[0, 1] > 0.97
    assert np.abs(of_flat.mean(axis=(0, 1)) / of_cube.mean(axis=(0, 1)) - 1).max() < 0.01


@pytest.mark.gl
def test_t20_balls_that_wear_ilms_cube_and_latlong_look_the_same(
    studio: Studio, corpus: Path
) -> None:
    seen = [
        ball(
            studio,
            {
                "texture": texture(studio, corpus / f"2_envmaps/openexr/WavyLines{name}.exr"),
                "layout": {"technique": layout},
            },
            MIRROR,
            256,
            supersampling=2,
        )
        for name, layout in (("LatLong", "latlong"), ("Cube", "cube"))
    ]

    normals, on_it = ball_normals(256)
    on_it &= np.hypot(normals[..., 0], normals[..., 1]) < 0.9
    flat, cube = (picture[on_it][:, 0] for picture in seen)
    assert np.corrcoef(flat, cube)[0, 1] > 0.97
