"""Pictures wrapped round things: cylinders, globes, and three projections at once."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.coded import MIDDLES, ORTHOGRAPHIC, places, shown
from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_letters import CASES, LETTER

pytestmark = pytest.mark.gl

LATLONG = {"technique": "latlong", "centre": "-x"}
GLOBE = {"type": "sphere", "segments": 256, "rings": 128}
NOISE = np.random.default_rng(9).random((32, 64, 3))
FROM_X = {**ORTHOGRAPHIC, "pose": {"eye": [4.0, 0.0, 0.0]}}
FROM_MINUS_X = {**ORTHOGRAPHIC, "pose": {"eye": [-4.0, 0.0, 0.0]}}


def cylindrical(**parameters: Any) -> dict[str, Any]:
    return {"technique": "cylindrical", **parameters}


def test_t26_the_angle_is_u_and_the_height_is_v(studio: Studio) -> None:
    # (-1, 1, z) -> u = .375; z = .5 of a picture from -.5 to 1.5 -> v = .5. Beyond, v is 0 or 1
    matrix = [1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0, 0]
    around = cylindrical(axis="z", base=-0.5, height=2.0, frame="world")
    color = {"texture": places(studio), "coordinates": around, "filter": "nearest"}

    seen = [
        shown(
            studio,
            {"type": "plane", "width": 0.01, "height": 0.01},
            color,
            1,
            camera={
                **ORTHOGRAPHIC,
                "height": 0.01,
                "pose": {"eye": [-1, 1, 9], "target": [-1, 1, 0]},
            },
            transform={"matrix": [*matrix, -1.0, 1.0, z, 1.0]},
        )[0, 0, :2]
        for z in (0.5, -3.0, 3.0)
    ]

    # The texels of 64 whose middles are nearest; beyond the top, the wrap comes round
    np.testing.assert_allclose(seen[0], [0.375, 0.5], atol=0.5 / 64 + 1e-6)
    assert seen[1][1] == 0.5 / 64


def test_t26_on_a_cylinder_they_are_its_own(studio: Studio) -> None:
    mesh = {"type": "cylinder", "segments": 512, "radius": 0.9, "height": 1.5}
    picture = studio.texture(NOISE)
    wrap = ["repeat", "clamp"]

    for camera in (FROM_X, FROM_MINUS_X):
        own = shown(studio, mesh, {"texture": picture, "wrap": wrap}, camera=camera)
        around = shown(
            studio,
            mesh,
            {"texture": picture, "wrap": wrap, "coordinates": cylindrical(height=1.5)},
            camera=camera,
        )

        # On a facet uv are linear and the angle is not: off by up to 64 (2 pi / 512)^2 / 8 / 2 pi
        # texels, of values up to 1 apart. Mean footprints differ near the rim.
        error = np.abs(own - around)
        assert np.median(error) < 1e-4
        assert np.quantile(error, 0.99) < 0.01


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_text_round_an_axis_reads_from_outside(studio: Studio, axis: str) -> None:
    # Each axis upright, from the side where u = 1/2
    eye, up = {
        "x": ([0.0, -4.0, 0.0], [1.0, 0, 0]),
        "y": ([-4.0, 0.0, 0.0], [0, 1.0, 0]),
        "z": ([-4.0, 0.0, 0.0], [0, 0, 1.0]),
    }[axis]
    around = cylindrical(axis=axis, base=-1.0, height=2.0)
    camera = {**ORTHOGRAPHIC, "pose": {"eye": eye, "up": up}}

    drawn = shown(
        studio,
        GLOBE,
        {"texture": studio.texture(LETTER), "coordinates": around},
        128,
        camera=camera,
    )

    assert_f(drawn)


@pytest.mark.parametrize("side", ["+x", "-x", "+y", "-y", "+z", "-z"])
def test_x02_three_projections_read_from_every_side(studio: Studio, side: str) -> None:
    _, eye, up, _ = CASES[f"box {side}"]
    color = {
        "texture": studio.texture(LETTER),
        "coordinates": {"technique": "triplanar"},
        "transform": {"offset": [0.5, 0.5]},
    }
    camera = {**ORTHOGRAPHIC, "pose": {"eye": eye, "up": [float(x) for x in up]}}

    drawn = shown(
        studio,
        {"type": "box", "width": 1.0, "height": 1.0, "depth": 1.0},
        color,
        128,
        camera=camera,
    )

    assert_f(drawn)


def test_x02_weights_are_those_of_the_reference(studio: Studio) -> None:
    # n = (.6, .48, .64), k = 4: (.369803575, .151471544, .478724881)
    normal = np.array([0.6, 0.48, 0.64])
    right = np.cross([0, 1.0, 0], normal)
    right /= np.linalg.norm(right)
    frame = np.eye(4)
    frame[:3, :3] = np.stack([right, np.cross(normal, right), normal], axis=1)
    middle = np.array([0.05, -0.2, 0.3])
    frame[:3, 3] = middle
    color = {
        "texture": places(studio),
        "coordinates": {"technique": "triplanar", "sharpness": 4.0, "frame": "world"},
        "transform": MIDDLES,
        "filter": "bilinear",
    }
    eye = middle + 3 * normal
    camera = {
        **ORTHOGRAPHIC,
        "height": 1e-3,
        "pose": {"eye": eye.tolist(), "target": middle.tolist()},
    }

    drawn = shown(
        studio, {"type": "plane"}, color, 1, camera=camera, transform={"matrix": list(frame.T.flat)}
    )

    x, y, z = middle
    projections = np.array([[-z, y], [x, -z], [x, y]])
    wanted = 0.5 + 0.4 * np.array([0.369803575, 0.151471544, 0.478724881]) @ projections
    np.testing.assert_allclose(drawn[0, 0, :2], wanted, atol=1e-6)


@pytest.mark.parametrize("sharpness", [0.0, 4.0, 64.0])
def test_x02_a_constant_picture_stays_constant(studio: Studio, sharpness: float) -> None:
    color = {
        "texture": {"technique": "constant", "value": [0.3, 0.6, 0.1]},
        "coordinates": {"technique": "triplanar", "sharpness": sharpness},
    }

    drawn = shown(studio, GLOBE, color)

    np.testing.assert_array_equal(
        drawn[drawn[..., 3] > 0][:, :3],
        np.float32([[0.3, 0.6, 0.1]]).repeat(1, axis=0) + 0 * drawn[drawn[..., 3] > 0][:, :3],
    )


@pytest.mark.parametrize("camera", [FROM_X, FROM_MINUS_X])
def test_t27_a_picture_round_a_point_is_a_globe_s_own(studio: Studio, camera: Any) -> None:
    # T27 on the unit sphere is T14: u = theta / 2 pi; turned to be read from outside, as a globe's
    picture = studio.texture(np.repeat(np.repeat(NOISE, 4, axis=0), 4, axis=1))
    round_a_point = {
        "texture": picture,
        "coordinates": {"technique": "position"},
        "layout": LATLONG,
        "transform": {"scale": [-1.0, 1.0]},
        "filter": "bilinear",
    }

    own = shown(
        studio,
        GLOBE,
        {"texture": picture, "wrap": ["repeat", "clamp"], "filter": "bilinear"},
        camera=camera,
    )
    drawn = shown(studio, GLOBE, round_a_point, camera=camera)

    x, y = np.meshgrid(*[(np.arange(64) + 0.5) / 32 - 1] * 2)
    near = (np.hypot(x, y) < 0.9) & (np.abs(y) < 0.85)  # at the poles uv are bent
    error = np.abs(own - drawn)[near]
    assert np.quantile(error, 0.99) < 0.01
    assert np.median(error) < 1e-3


@pytest.mark.parametrize("filter_name", ["nearest", "bilinear", "trilinear", "anisotropic"])
@pytest.mark.parametrize(
    "where",
    [
        {"coordinates": {"technique": "position"}, "layout": {"technique": "latlong"}},
        {"coordinates": {"technique": "normal"}, "layout": {"technique": "latlong"}},
        {"coordinates": {"technique": "cylindrical", "base": -1.0, "height": 2.0}},
    ],
)
def test_no_line_shows_where_the_picture_s_ends_meet(
    studio: Studio, where: dict[str, Any], filter_name: str
) -> None:
    # Half a turn round the axis and half a tile along u are the same thing.
    picture = studio.texture(NOISE)

    def seen(eye: list[float], shift: float) -> np.ndarray:
        color = {
            "texture": picture,
            **where,
            "transform": {"offset": [shift, 0.0]},
            "filter": filter_name,
        }
        camera = {**ORTHOGRAPHIC, "pose": {"eye": eye}}
        return shown(studio, GLOBE, color, 65, camera=camera)

    ends = [4.0, 0, 0] if "layout" not in where else [0, 0, -4.0]
    at_the_seam, opposite = seen(ends, 0.0), seen([-x for x in ends], 0.5)

    # 65 pixels: the seam runs through the middle of a column of pixels
    error = np.abs(at_the_seam - opposite).max(axis=2)
    worst = 1.0 if filter_name == "nearest" else 2e-3
    assert np.quantile(error, 0.98) < 2e-4
    assert error[10:55, 10:55].max() < worst


def assert_f(drawn: np.ndarray) -> None:
    """The letter of test_letters stands upright and its arms point to the right."""

    def middle(colour: list[int]) -> tuple[float, float]:
        rows, columns = np.nonzero(np.abs(drawn[..., :3] - colour).max(axis=2) < 0.2)
        assert len(rows) > 8
        return float(rows.mean()), float(columns.mean())

    stem, upper, lower = middle([1, 0, 0]), middle([0, 1, 0]), middle([0, 0, 1])
    assert stem[1] < lower[1] < upper[1], "the arms point to the right"
    assert upper[0] < lower[0], "the longer arm is on top"
    assert upper[0] < stem[0]
