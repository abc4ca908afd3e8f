import math

import pytest

from api_schemas.camera import FramedCamera, OrthographicCamera, PerspectiveCamera
from api_schemas.coverage import coverage, stand_in
from api_schemas.geometry import IDENTITY, Affine

EYE = {"eye": [0.0, 0.0, 5.0]}
SQUARE = PerspectiveCamera.model_validate({"type": "perspective", "pose": EYE, "fov_y": 1.0})
FLAT = OrthographicCamera.model_validate({"type": "orthographic", "pose": EYE, "height": 4.0})
ASTRAY = PerspectiveCamera.model_validate(
    {"type": "perspective", "pose": {"eye": [0.0] * 3, "target": [0.0] * 3}}
)


def at(x: float, y: float, z: float, stretch: float = 1.0) -> Affine:
    return Affine((stretch, 0, 0), (0, stretch, 0), (0, 0, stretch), (x, y, z))


def test_a_ball_under_parallel_rays_covers_its_disc():
    assert coverage(1.0, IDENTITY, FLAT, 2.0) == pytest.approx(math.pi / (4.0 * 8.0))


@pytest.mark.parametrize("distance", [3.0, 10.0, 100.0])
def test_a_ball_covers_no_more_than_is_said(distance):
    outline = 1 / math.sqrt(distance**2 - 1)  # tangent of the cone that touches the ball
    exact = math.pi * (outline / (2 * math.tan(0.5))) ** 2

    told = coverage(0.5, at(0, 0, 5 - distance, 2.0), SQUARE, 1.0)

    assert min(exact, 1.0) <= told <= exact * (distance / (distance - 1)) ** 3


def test_what_holds_the_eye_covers_all_and_what_is_behind_nothing():
    assert coverage(1.0, at(0, 0, 5.5), SQUARE, 1.0) == 1.0
    assert coverage(1.0, at(0, 0, 7), SQUARE, 1.0) == 0.0


@pytest.mark.parametrize("camera", [SQUARE, FLAT, ASTRAY])
def test_what_has_no_usable_place_covers_all(camera):
    assert coverage(1.0, None, camera, 1.0) == 1.0
    assert coverage(1.0, at(0, 0, -1e200, 1e200), camera, 1.0) == 1.0


def test_an_unknown_eye_may_see_nothing_else():
    assert coverage(1.0, at(0, 0, -50), None, 1.0) == 1.0


@pytest.mark.parametrize("aspect", [0.25, 1.0, 4.0])
@pytest.mark.parametrize("direction", [[0.0, 0.0, 1.0], [3.0, -2.0, 1.0]])
def test_a_framed_ball_covers_about_what_touches_the_edges(aspect, direction):
    framed = FramedCamera(type="framed", direction=direction)

    told = coverage(7.0, at(1e5, 0, 9), stand_in(framed, [(7.0, at(1e5, 0, 9))], aspect), aspect)

    # A disc whose width is the shorter side; the free space round it is not told.
    exact = math.pi / 4 * min(aspect, 1 / aspect)
    assert exact <= told <= 6 * exact


def test_many_framed_things_share_the_picture():
    row = [(1.0, at(10.0 * x, 0, 0)) for x in range(20)]
    camera = stand_in(FramedCamera(type="framed", direction=[0.0, 0.0, 1.0]), row, 1.0)

    told = sum(coverage(reach, place, camera, 1.0) for reach, place in row)

    # Discs of a 192nd of the picture's width, and a little more.
    exact = 20 * math.pi / 192**2
    assert exact <= told <= 2 * exact


@pytest.mark.parametrize(
    "balls",
    [[], [(1.0, None)], [(1.0, at(0, 0, 0)), (1.0, None)]],
    ids=["none", "astray", "one astray"],
)
def test_what_cannot_be_framed_is_not_told(balls):
    assert stand_in(FramedCamera(type="framed"), balls, 1.0) is None
    nowhere = FramedCamera(type="framed", direction=[0.0, 0.0, 0.0])
    assert stand_in(nowhere, [(1.0, at(0, 0, 0))], 1.0) is None
