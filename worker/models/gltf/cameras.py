"""Cameras and lights where their nodes stand, as cameras and lights of our language."""

from typing import Final

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from api_schemas.base import LENGTH_MAX, LENGTH_MIN
from api_schemas.camera import OrthographicCamera, PerspectiveCamera, PosedCamera
from api_schemas.transforms import MatrixPlacement
from worker.models.gltf.document import scene as gltf
from worker.models.model import NamedCamera

_WIDEST: Final = 3.1


def camera_at(
    camera: gltf.Camera, node: gltf.Node, matrix: NDArray[np.float64]
) -> NamedCamera | str:
    """Place a camera; glTF's looks along its own -z with y up, as ours does.

    A perspective without zfar reaches as far as can be drawn. The width of the view follows from
    the picture: aspectRatio and xmag are hints for a viewport that we do not have.

    Args:
        camera: What is seen.
        node: Who carries it; gives its name to a camera without one.
        matrix: model_from_node.

    Returns:
        The camera, or why there is none.
    """
    try:
        posed = _posed(camera, _pose(matrix))
    except ValidationError:
        return "a camera beyond what can be drawn is left out"
    if posed is None:
        return "a camera that is mirrored, too wide or of an unknown type is left out"
    return NamedCamera(camera.name or node.name, posed)


def _posed(camera: gltf.Camera, pose: MatrixPlacement) -> PosedCamera | None:
    if camera.type == "perspective" and camera.perspective is not None:
        view = camera.perspective
        if view.yfov > _WIDEST:
            return None
        far = LENGTH_MAX if view.zfar is None else view.zfar
        return PerspectiveCamera(
            type="perspective",
            pose=pose,
            near=max(view.znear, LENGTH_MIN),
            far=min(far, LENGTH_MAX),
            fov_y=view.yfov,
        )
    if camera.type == "orthographic" and camera.orthographic is not None:
        box = camera.orthographic
        if box.ymag < 0 or box.xmag < 0:
            return None
        return OrthographicCamera(
            type="orthographic",
            pose=pose,
            near=max(box.znear, LENGTH_MIN),
            far=min(box.zfar, LENGTH_MAX),
            height=2 * box.ymag,
        )
    return None


def _pose(matrix: NDArray[np.float64]) -> MatrixPlacement:
    affine = matrix.copy()
    affine[3] = 0, 0, 0, 1
    return MatrixPlacement(matrix=affine.T.ravel().tolist())
