"""Matrices in float64: where things stand, and how the eye sees them.

A matrix named a_from_b takes column vectors of frame b to frame a. The world is right-handed with
y up; a camera looks along its own -z.
"""

import math

import numpy as np
from numpy.typing import NDArray

from api_schemas.camera import LookAt, OrthographicCamera, PerspectiveCamera
from api_schemas.geometry import affine
from api_schemas.transforms import MatrixPlacement, Transform
from worker.errors import RenderError

Matrix = NDArray[np.float64]
_NO_LENGTH = 1e-13  # below every length and sine that api_schemas.feasibility lets through


def parent_from_node(transform: Transform) -> Matrix:
    """Turn a request's transform into a matrix: scale, then turn, then move, or its own matrix.

    Raises:
        RenderError: There is no such map: no turn, or a last row that is not 0 0 0 1
            (`transform_singular`).
    """
    placed = affine(transform)
    if placed is None:
        raise RenderError("the transform is not an affine map", code="transform_singular")
    matrix = np.eye(4)
    matrix[:3] = np.stack([placed.x, placed.y, placed.z, placed.origin], axis=1)
    return matrix


def world_from_camera(pose: LookAt | MatrixPlacement) -> Matrix:
    """Give the camera's frame: its columns are right, up, backward and the eye.

    A matrix may turn and move but its scale is taken out, so that distances stay distances.

    Raises:
        RenderError: Eye and target are equal, up points along the view, or the matrix is singular
            (`camera_degenerate`).
    """
    if isinstance(pose, MatrixPlacement):
        return orthonormal(parent_from_node(pose))
    eye, target, up = (np.array(v, dtype=np.float64) for v in (pose.eye, pose.target, pose.up))
    backward = _unit(eye - target, "the camera's eye and target are one point")
    upward = _unit(up, "the camera's up vector has no length")
    right = _unit(np.cross(upward, backward), "the camera looks along its up vector")
    matrix = np.eye(4)
    matrix[:3, :4] = np.stack([right, np.cross(backward, right), backward, eye], axis=1)
    return matrix


def orthonormal(matrix: Matrix) -> Matrix:
    """Take scale and shear out of a camera's frame; it looks where it looked.

    Raises:
        RenderError: The matrix is singular (`camera_degenerate`).
    """
    backward = _unit(matrix[:3, 2], "the camera's matrix is singular")
    upward = _unit(matrix[:3, 1], "the camera's matrix is singular")
    right = _unit(np.cross(upward, backward), "the camera's matrix is singular")
    result = np.eye(4)
    result[:3, :4] = np.stack([right, np.cross(backward, right), backward, matrix[:3, 3]], axis=1)
    return result


def _unit(vector: NDArray[np.float64], complaint: str) -> NDArray[np.float64]:
    length = np.linalg.norm(vector)
    if not length > _NO_LENGTH:
        raise RenderError(complaint, code="camera_degenerate")
    return vector / length


def rigid_inverse(matrix: Matrix) -> Matrix:
    """Invert a matrix that only turns and moves."""
    inverse = np.eye(4)
    inverse[:3, :3] = matrix[:3, :3].T
    inverse[:3, 3] = -matrix[:3, :3].T @ matrix[:3, 3]
    return inverse


def clip_from_camera(camera: PerspectiveCamera | OrthographicCamera, aspect: float) -> Matrix:
    """Project to clip space with reversed depth: 1 at the near plane, 0 at the far plane.

    Reversed depth spends the float's precision evenly over the scene (Reed, 2015).

    Args:
        camera: The projection's angles and distances.
        aspect: Width over height of the picture.

    Raises:
        RenderError: far is not beyond near (`camera_degenerate`).
    """
    near, far = camera.near, camera.far
    if not far > near:
        raise RenderError(
            f"far is {far:g}; it must be more than near, {near:g}", code="camera_degenerate"
        )
    if isinstance(camera, PerspectiveCamera):
        return perspective(camera.fov_y, aspect, near, far)
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[1, 1] = 2 / (camera.height * aspect), 2 / camera.height
    matrix[2, 2], matrix[2, 3] = 1 / (far - near), far / (far - near)
    matrix[3, 3] = 1.0
    return matrix


def perspective(fov_y: float, aspect: float, near: float, far: float) -> Matrix:
    """Project to clip space with reversed depth as far things are small; 0 < near < far.

    Args:
        fov_y: Angle in radians from the lower to the upper edge.
        aspect: Width over height of the picture.
        near: Distance of the plane with depth 1.
        far: Distance of the plane with depth 0.
    """
    focal = 1 / math.tan(fov_y / 2)
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[1, 1] = focal / aspect, focal
    matrix[2, 2], matrix[2, 3] = near / (far - near), near * far / (far - near)
    matrix[3, 2] = -1.0
    return matrix


def normal_matrix(world_from_object: Matrix) -> Matrix:
    """Give the 3 x 3 matrix that keeps normals outward: the cofactors, signed by the determinant.

    It equals the inverse transpose up to a positive factor and exists for flat scales too.

    Args:
        world_from_object: (..., 4, 4), one matrix or many.
    """
    m = world_from_object[..., :3, :3]
    x, y, z = m[..., 0, :], m[..., 1, :], m[..., 2, :]
    cofactors = np.stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)], axis=-2)
    largest = np.abs(cofactors).max(axis=(-2, -1), keepdims=True)
    flip = np.where(np.linalg.det(m) < 0, -1.0, 1.0)[..., None, None]
    scaled = np.divide(cofactors * flip, largest, out=np.zeros_like(m), where=largest > 0)
    return np.where(largest > 0, scaled, np.eye(3))
