"""What a light sees: the axes, reach and matrices of its shadow maps, on the processor alone.

A map has its own axes, across, up and along (where the light looks), and texels counted from its
lower left corner. Depth is reversed: 1 where the map begins, 0 where it ends or where nothing is,
and affine in the texels over every plane.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.light_cost import faces_of
from api_schemas.lights import DirectionalLight, PointLight, SpotLight
from worker.geometry.transforms import Matrix

_NEAREST = 1e-4
"""Where the maps of a cone begin, of the distance to the farthest thing."""
_GUARD = 2
"""Texels by which a map reaches beyond what it must show, besides the radius of its soft edge."""
_SMALLEST = 1e-30
_FLATTEST = 1e-6
"""Of the width or place of what is drawn: a map of a single point is still one of numbers."""

Lamp = DirectionalLight | PointLight | SpotLight
Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LightView:
    """One shadow map, or the six round a point.

    Attributes:
        light: The number of the light among those that are not ambient.
        axes: (3, 3): across, up and along in the world, unit length.
        origin: Where the axes meet in the world; of parallel light the middle of the map's start.
        parallel: Whether all rays go along; otherwise they come from the origin.
        all_round: Whether there are six faces.
        resolution: Texels along a side.
        focal: Texels per unit of length, or per unit of the tangent.
        reach: Depth is (reach - z) / reach of parallel light, else `near` / z.
        near: Where a cone's map begins.
        bias: In texels.
        radius: In texels.
    """

    light: int
    axes: Matrix
    origin: Vector
    parallel: bool
    all_round: bool
    resolution: int
    focal: float
    reach: float
    near: float
    bias: float
    radius: int

    @property
    def faces(self) -> int:
        """How many maps it has."""
        return 6 if self.all_round else 1

    def clip_from_world(self, face: int) -> Matrix:
        """Give the matrix that draws one of its maps."""
        across, up, along = _face_axes(self.axes, face) if self.all_round else self.axes
        scale = 2 * self.focal / self.resolution
        rows = np.zeros((4, 4))
        rows[0, :3], rows[1, :3] = scale * across, scale * up
        if self.parallel:
            rows[2, :3] = -along / self.reach
        else:
            rows[3, :3] = along
        rows[:, 3] = -rows[:, :3] @ self.origin
        rows[2, 3] += 1.0 if self.parallel else self.near
        rows[3, 3] += 1.0 if self.parallel else 0.0
        return rows


def light_views(lamps: Sequence[Lamp], corners: NDArray[np.float64]) -> list[LightView]:
    """Return the maps of all lights with shadows.

    Args:
        lamps: The lights that are not ambient; directions have a length.
        corners: (n, 3) of boxes that hold all that is drawn, in the world.
    """
    return [
        _parallel(lamp, number, corners)
        if isinstance(lamp, DirectionalLight)
        else _central(lamp, number, corners)
        for number, lamp in enumerate(lamps)
        if lamp.shadow is not None
    ]


def light_axes(direction: Sequence[float], up: Vector | None = None) -> Matrix:
    """Give across, up and along of a light that looks along a direction: (3, 3), right-handed back.

    Seen along the light, `up` (y, or x where the light goes along y) points upwards and across to
    the right.
    """
    along = np.array(direction, dtype=np.float64)
    along /= np.abs(along).max()
    along /= np.linalg.norm(along)
    if up is None or not np.linalg.norm(np.cross(along, up)) > 1e-6 * np.linalg.norm(up):
        up = np.array([0.0, 1.0, 0.0] if abs(along[1]) < 0.99 else [1.0, 0.0, 0.0])
    across = np.cross(along, up)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(across, along), along])


def _parallel(lamp: DirectionalLight, number: int, corners: NDArray[np.float64]) -> LightView:
    shadow = lamp.shadow
    assert shadow is not None
    axes = light_axes(lamp.direction)
    seen = corners @ axes.T if len(corners) else np.zeros((1, 3))
    low, high = seen.min(axis=0), seen.max(axis=0)
    size = max((high - low).max(), _FLATTEST * np.abs(seen).max(), _FLATTEST**2)
    room = shadow.resolution - 2 * (_GUARD + shadow.radius)
    width = max(high[0] - low[0], high[1] - low[1], _FLATTEST * size)
    start = np.append((low[:2] + high[:2]) / 2, low[2] - 0.01 * size)
    return LightView(
        light=number,
        axes=axes,
        origin=axes.T @ start,
        parallel=True,
        all_round=False,
        resolution=shadow.resolution,
        focal=room / width,
        reach=float(high[2] - low[2] + 0.02 * size),
        near=0.0,
        bias=shadow.bias,
        radius=shadow.radius,
    )


def _central(lamp: PointLight | SpotLight, number: int, corners: NDArray[np.float64]) -> LightView:
    shadow = lamp.shadow
    assert shadow is not None
    origin = np.array(lamp.position, dtype=np.float64)
    reach = float(np.linalg.norm(corners - origin, axis=1).max(initial=_SMALLEST))
    all_round = faces_of(lamp) == 6
    room = shadow.resolution / 2 - _GUARD - shadow.radius
    slope = 1.0 if all_round else max(math.tan(lamp.outer_angle), 1e-3)  # type: ignore[union-attr]
    return LightView(
        light=number,
        axes=np.eye(3) if all_round else light_axes(lamp.direction),  # type: ignore[union-attr]
        origin=origin,
        parallel=False,
        all_round=all_round,
        resolution=shadow.resolution,
        focal=room / slope,
        reach=reach,
        near=_NEAREST * reach,
        bias=shadow.bias,
        radius=shadow.radius,
    )


def _face_axes(axes: Matrix, face: int) -> Matrix:
    """Turn the axes to one of six faces: +x, -x, +y, -y, +z, -z; lib/shadows.glsl does the same."""
    along = face // 2
    sign = -1.0 if face % 2 else 1.0
    return np.stack([axes[(along + 1) % 3], axes[(along + 2) % 3], sign * axes[along]])
