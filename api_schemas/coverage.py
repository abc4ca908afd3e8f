"""How much of a picture a mesh covers at most, told from the ball round it."""

import math
from collections.abc import Iterable

from api_schemas.camera import (
    Camera,
    FramedCamera,
    LookAt,
    OrthographicCamera,
    PerspectiveCamera,
    PosedCamera,
)
from api_schemas.geometry import Affine, Vector3, affine, dot, length, triple
from api_schemas.transforms import MatrixPlacement


def coverage(reach: float, placed: Affine | None, camera: Camera | None, aspect: float) -> float:
    """Return the share of the picture, 0..1, that lies behind the ball's outline.

    Args:
        reach: Radius of a ball round the mesh's origin that holds the mesh.
        placed: Where the mesh stands; without a place it covers everything.
        camera: The eye; one that is not known may see nothing else.
        aspect: Width over height of the picture.
    """
    if not isinstance(camera, PosedCamera):
        return 1.0
    view = _view(camera)
    if placed is None or view is None:
        return 1.0
    eye, forward = view
    radius = _radius(reach, placed)
    if isinstance(camera, OrthographicCamera):
        share = radius / camera.height
        return min(1.0, math.pi * share * share / aspect)
    way = _difference(placed.origin, eye)
    depth = dot(way, forward)
    if depth <= -radius:
        return 0.0
    if depth <= radius:
        return 1.0
    outline = radius / (depth - radius)
    slant = length(way) / depth  # what stands aside is drawn longer
    picture = 4 * math.tan(camera.fov_y / 2) ** 2 * aspect
    return min(1.0, math.pi * outline * outline * slant / picture)


def stand_in(
    camera: FramedCamera, balls: Iterable[tuple[float, Affine | None]], aspect: float
) -> PerspectiveCamera | None:
    """Return a camera that is about where one that frames everything will be, or nearer.

    Args:
        camera: The one that will frame.
        balls: The radius round the origin, and the place, of each thing that is drawn. If one has
            no place, there is no telling.
        aspect: Width over height of the picture.
    """
    lows, highs = [], []
    for reach, placed in balls:
        if placed is None:
            return None
        radius = _radius(reach, placed)
        if math.isinf(radius):
            continue  # what has no end is not framed
        lows.append([value - radius for value in placed.origin])
        highs.append([value + radius for value in placed.origin])
    size = length(triple(camera.direction))
    if not lows or not size:
        return None
    low, high = (
        [min(side) for side in zip(*lows, strict=True)],
        [max(side) for side in zip(*highs, strict=True)],
    )
    # The widest side fits into the narrower angle; its corners may reach out of the picture.
    widest = max(b - a for a, b in zip(low, high, strict=True))
    distance = widest / 2 / (math.tan(camera.fov_y / 2) * min(1.0, aspect))
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    eye = [m + distance * d / size for m, d in zip(middle, camera.direction, strict=True)]
    # Unchecked: things may stand farther away than a request may put a camera.
    pose = LookAt.model_construct(eye=eye, target=middle, up=camera.up)
    return PerspectiveCamera.model_construct(type="perspective", pose=pose, fov_y=camera.fov_y)


def _radius(reach: float, placed: Affine) -> float:
    return reach * max(length(placed.x), length(placed.y), length(placed.z))


def _view(camera: PosedCamera) -> tuple[Vector3, Vector3] | None:
    """Return where the eye is and the unit vector of where it looks, if there is one."""
    pose = camera.pose
    if isinstance(pose, MatrixPlacement):
        placed = affine(pose)
        if placed is None:
            return None
        eye, forward = placed.origin, _difference((0, 0, 0), placed.z)
    else:
        eye, forward = triple(pose.eye), _difference(triple(pose.target), triple(pose.eye))
    size = length(forward)
    return (eye, (forward[0] / size, forward[1] / size, forward[2] / size)) if size else None


def _difference(a: Vector3, b: Vector3) -> Vector3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])
