import math

import numpy as np
import pytest

from api_schemas.camera import LookAt, OrthographicCamera, PerspectiveCamera
from api_schemas.feasibility import obstacles
from api_schemas.requests import RenderRequest
from api_schemas.transforms import MatrixPlacement, Placement, Transform
from worker.errors import RenderError
from worker.geometry import transforms

POSE = LookAt(eye=[0.0, 0.0, 0.0], target=[0.0, 0.0, -1.0])


def test_a_placement_scales_then_turns_then_moves() -> None:
    half = math.sqrt(0.5)
    placement = Placement(
        translation=[10.0, 0.0, 0.0], rotation=[0.0, half, 0.0, half], scale=[2.0, 3.0, 4.0]
    )

    # A quarter turn about y takes x to -z.
    moved = transforms.parent_from_node(placement) @ [1, 1, 0, 1]

    np.testing.assert_allclose(moved, [10, 3, -2, 1], atol=1e-15)


def test_a_quaternions_length_does_not_matter() -> None:
    turned = transforms.parent_from_node(Placement(rotation=[2.0, 0.0, 0.0, 2.0]))

    np.testing.assert_allclose(turned[:3, :3], [[1, 0, 0], [0, 0, -1], [0, 1, 0]], atol=1e-15)


@pytest.mark.parametrize(
    "transform",
    [
        Placement(rotation=[0.0] * 4),
        MatrixPlacement(matrix=np.diag([1.0, 1, 1, 2]).ravel().tolist()),
    ],
    ids=["no turn", "not affine"],
)
def test_what_is_no_affine_map_is_refused_by_name(transform: Transform) -> None:
    with pytest.raises(RenderError) as caught:
        transforms.parent_from_node(transform)

    assert caught.value.code == "transform_singular"


def test_a_matrix_is_read_column_by_column() -> None:
    numbers = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 7.0, 8.0, 9.0, 1.0]

    matrix = transforms.parent_from_node(MatrixPlacement(matrix=numbers))

    np.testing.assert_array_equal(matrix[:3, 3], [7, 8, 9])


def test_look_at_puts_the_target_in_the_middle_and_up_upwards() -> None:
    pose = LookAt(eye=[3.0, 4.0, 5.0], target=[-1.0, 2.0, 0.5], up=[0.1, 1.0, 0.2])

    camera_from_world = transforms.rigid_inverse(transforms.world_from_camera(pose))
    target = camera_from_world @ [*pose.target, 1]
    up = camera_from_world[:3, :3] @ pose.up

    distance = math.dist(pose.eye, pose.target)
    np.testing.assert_allclose(target, [0, 0, -distance, 1], atol=1e-14)
    assert abs(up[0]) < 1e-15
    assert up[1] > 0


@pytest.mark.parametrize(
    "pose",
    [
        LookAt(eye=[0.0, 0.0, 2e-12]),
        LookAt(eye=[0.0, 0.0, 1.0], up=[0.0, 2e-12, 0.0]),
        LookAt(eye=[0.0, 0.0, 1.0], up=[0.0, 2e-7, 1.0]),
        MatrixPlacement(matrix=np.diag([1e-9, 1e-9, 1e-9, 1.0]).ravel().tolist()),
    ],
    ids=["near", "short up", "almost along up", "small matrix"],
)
def test_a_camera_at_the_bounds_of_what_is_let_in_is_a_rotation(
    pose: LookAt | MatrixPlacement,
) -> None:
    request = RenderRequest.model_validate(
        {"scene": {"camera": {"type": "perspective", "pose": pose.model_dump()}, "nodes": []}}
    )
    assert obstacles(request) == []

    turn = transforms.world_from_camera(pose)[:3, :3]

    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-9)


@pytest.mark.parametrize(
    "pose",
    [
        LookAt(eye=[1.0, 2.0, 3.0], target=[1.0, 2.0, 3.0]),
        LookAt(eye=[0.0, 5.0, 0.0]),
        LookAt(eye=[0.0, 0.0, 5.0], up=[0.0, 0.0, 0.0]),
        MatrixPlacement(matrix=[0.0] * 15 + [1.0]),
    ],
    ids=["eye is target", "along up", "no up", "no axes"],
)
def test_degenerate_cameras_are_refused_by_name(pose: LookAt | MatrixPlacement) -> None:
    with pytest.raises(RenderError) as caught:
        transforms.world_from_camera(pose)

    assert caught.value.code == "camera_degenerate"


def test_perspective_maps_near_to_one_and_far_to_zero() -> None:
    camera = PerspectiveCamera(type="perspective", pose=POSE, fov_y=1.0, near=0.5, far=20.0)
    clip_from_camera = transforms.clip_from_camera(camera, aspect=2.0)
    top = 7 * math.tan(0.5)

    near, far, corner = (
        clip_from_camera @ point
        for point in ([0, 0, -0.5, 1], [0, 0, -20, 1], [2 * top, top, -7, 1])
    )

    assert near[2] / near[3] == pytest.approx(1, abs=1e-15)
    assert far[2] / far[3] == pytest.approx(0, abs=1e-15)
    np.testing.assert_allclose(corner[:2] / corner[3], [1, 1], rtol=1e-15)


def test_orthographic_maps_its_height_to_the_picture() -> None:
    camera = OrthographicCamera(type="orthographic", pose=POSE, height=4.0, near=1.0, far=3.0)

    clip_from_camera = transforms.clip_from_camera(camera, aspect=0.5)

    np.testing.assert_allclose(clip_from_camera @ [1, 2, -1, 1], [1, 1, 1, 1], rtol=1e-15)
    np.testing.assert_allclose(clip_from_camera @ [-1, -2, -3, 1], [-1, -1, 0, 1], atol=1e-15)


def test_far_must_be_beyond_near() -> None:
    camera = PerspectiveCamera.model_construct(pose=POSE, fov_y=1.0, near=2.0, far=2.0)

    with pytest.raises(RenderError, match="far"):
        transforms.clip_from_camera(camera, 1.0)


def test_normal_matrix_is_the_inverse_transpose_up_to_a_positive_factor() -> None:
    random = np.random.default_rng(3)

    for _ in range(20):
        matrix = random.normal(size=(4, 4))
        expected = np.linalg.inv(matrix[:3, :3]).T
        ratio = transforms.normal_matrix(matrix) / expected
        np.testing.assert_allclose(ratio, ratio[0, 0], rtol=1e-9)
        assert ratio[0, 0] > 0


def test_a_flattened_object_keeps_its_normal() -> None:
    flat = np.diag([1.0, 1.0, 0.0, 1.0])

    np.testing.assert_array_equal(transforms.normal_matrix(flat) @ [0.3, 0.2, 1.0], [0, 0, 1])
