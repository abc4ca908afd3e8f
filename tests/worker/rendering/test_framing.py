import math

import numpy as np
import pytest

from api_schemas import meshes
from api_schemas.camera import FramedCamera
from worker.errors import RenderError
from worker.geometry.primitives import build
from worker.geometry.transforms import rigid_inverse
from worker.rendering.framing import Framing, frame, lamp

MARGIN = 0.05
EDGE = 1 / 1.1  # where the free space begins, with 1 at the picture's edge
TURNED = np.eye(4)
TURNED[:3, :3] = [[0.6, -0.8, 0.0], [1.6, 1.2, 0.0], [0.0, 0.0, -0.5]]  # stretched and mirrored
TURNED[:3, 3] = [3.0, -2.0, 1.0]
THINGS = [
    (build(meshes.Sphere(type="sphere", segments=16, rings=8)).positions, np.eye(4)),
    (build(meshes.Cylinder(type="cylinder", height=5.0)).positions, TURNED),
    (build(meshes.Box(type="box", width=0.1)).positions, 2 * TURNED + np.diag([0.0, 0, 0, -1])),
]


def framed(placed, direction, fov_y=0.8, aspect=1.0, **more) -> Framing:
    camera = FramedCamera(
        type="framed",
        direction=[float(x) for x in direction],
        fov_y=fov_y,
        **{"margin": MARGIN} | more,
    )
    return frame(camera, placed, aspect)


def in_picture(framing: Framing, placed) -> np.ndarray:
    """Where vertices land: x and y from -1 to 1 in the picture, depth from 0 to 1."""
    clip_from_world = framing.clip_from_camera @ rigid_inverse(framing.world_from_camera)
    points = np.concatenate([vertices @ m[:3, :3].T + m[:3, 3] for vertices, m in placed])
    clip = np.column_stack([points, np.ones(len(points))]) @ clip_from_world.T
    assert (clip[:, 3] > 0).all(), "something is behind the eye"
    return clip[:, :3] / clip[:, 3:]


@pytest.mark.parametrize("aspect", [0.01, 0.5, 1.0, 16 / 9, 8.0])
@pytest.mark.parametrize("fov_y", [0.01, 0.8, 1.2])
@pytest.mark.parametrize(
    "direction", [(0.5, 0.4, 1), (0, 0, 1), (1, 0, 0), (0.001, 1, 0), (-3, -9, 1), (10, 1e6, 0)]
)
def test_everything_is_inside_and_fills_one_axis(aspect, fov_y, direction) -> None:
    framing = framed(THINGS, direction, fov_y, aspect)

    places = in_picture(framing, THINGS)

    low, high = places.min(axis=0), places.max(axis=0)
    # A twentieth of the scene's size on either side of the tighter axis, and more of the other.
    assert low[:2].min() >= -EDGE - 1e-9
    assert high[:2].max() <= EDGE + 1e-9
    assert (high - low)[:2].max() == pytest.approx(2 * EDGE, abs=1e-9)
    assert 0 < low[2] < high[2] < 1


def test_it_looks_from_the_direction_with_y_up() -> None:
    framing = framed(THINGS, (2, 0, 0))

    np.testing.assert_allclose(framing.world_from_camera[:3, 2], [1, 0, 0], atol=1e-15)
    np.testing.assert_allclose(framing.world_from_camera[:3, 1], [0, 1, 0], atol=1e-15)
    assert np.linalg.det(framing.world_from_camera[:3, :3]) == pytest.approx(1)


def test_another_up_looks_from_above() -> None:
    framing = framed(THINGS, (0, 3, 0), up=[0.0, 0.0, -1.0])

    np.testing.assert_allclose(framing.world_from_camera[:3, 1], [0, 0, -1], atol=1e-15)


@pytest.mark.parametrize("direction", [(0, 1, 0), (0, 0, 0)])
def test_along_up_or_from_nowhere_is_degenerate(direction) -> None:
    with pytest.raises(RenderError) as caught:
        framed(THINGS, direction)

    assert caught.value.code == "camera_degenerate"


def test_a_unit_ball_is_as_far_as_its_sine_says() -> None:
    ball = [(build(meshes.Sphere(type="sphere", segments=512, rings=256)).positions, np.eye(4))]

    framing = framed(ball, (0, 0, 1), 2 * math.atan(0.5), margin=0.0)

    # The edges touch the ball: 1 / sin(half angle); facets cut off less than 1e-4 of it.
    assert framing.world_from_camera[2, 3] == pytest.approx(math.sqrt(5), rel=1e-4)


@pytest.mark.parametrize(
    "placed",
    [
        [],
        [(np.zeros((0, 3)), np.eye(4))],
        [(np.zeros((5, 3)), np.eye(4))],
        [(np.array([[0.0, 0, 0], [0, 0, 7.0]]), np.eye(4))],
        [(np.array([[1e6, 1e6, 1e6], [1e6 + 1, 1e6, 1e6]]), np.eye(4))],
        [(np.array([[0.0, 0, 0], [1e-6, 0, 0]]), np.eye(4))],
        [(np.array([[-1e9, 0, 0], [1e9, 0, 0]]), np.eye(4))],
    ],
    ids=["nothing", "no vertices", "a point", "a line to the eye", "far away", "tiny", "huge"],
)
def test_what_has_no_width_is_still_seen(placed) -> None:
    framing = framed(placed, (0, 0, 1), aspect=2.0)

    assert np.isfinite(framing.clip_from_camera).all()
    places = in_picture(framing, [*placed, (np.zeros((0, 3)), np.eye(4))])
    # Coordinates of a million keep ten digits.
    assert (np.abs(places[:, :2]) < EDGE + 1e-6).all()
    assert ((places[:, 2] > 0) & (places[:, 2] < 1)).all()


def test_the_lamp_comes_from_behind_the_eye_and_moves_with_it() -> None:
    for direction in ((0, 0, 1), (-1, 2, 3), (1, -1, 0)):
        eye = framed(THINGS, direction).world_from_camera
        travels = np.array(lamp(eye)[1].direction)

        seen = eye[:3, :3].T @ travels
        assert (seen < 0).all(), "to the left, down and away from the eye"
