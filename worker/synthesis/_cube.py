"""Light on a sphere as six faces of a cube, in OpenGL's order and orientation (T20).

Faces are +x, -x, +y, -y, +z, -z, float32 (6, side, side, 3), row 0 at t = 0. A pyramid holds each
level with a rim of one texel from the neighbouring faces, so that light is read without a seam.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Faces = NDArray[np.float32]

# For each face the world axes along s, along t and outwards
_AXES = np.array(
    [
        [[0, 0, -1], [0, -1, 0], [1, 0, 0]],
        [[0, 0, 1], [0, -1, 0], [-1, 0, 0]],
        [[1, 0, 0], [0, 0, 1], [0, 1, 0]],
        [[1, 0, 0], [0, 0, -1], [0, -1, 0]],
        [[1, 0, 0], [0, -1, 0], [0, 0, 1]],
        [[-1, 0, 0], [0, -1, 0], [0, 0, -1]],
    ],
    dtype=np.float64,
)


class Pyramid(NamedTuple):
    """Faces at full, half, a quarter ... of their side, each with its rim, in one array.

    Level k has faces of (sides[k] + 2)^2 texels from starts[k] on in `texels` (n, 3).
    """

    texels: NDArray[np.float32]
    starts: NDArray[np.int64]
    sides: NDArray[np.int64]


def face_directions(side: int, rim: int = 0) -> Floats:
    """Return unit directions (6, side + 2 rim, side + 2 rim, 3) of texel centres."""
    places = (2 * np.arange(-rim, side + rim) + 1) / side - 1
    s, t = np.meshgrid(places, places)
    ones = np.ones_like(s)
    directions: Floats = np.stack([s, t, ones], axis=-1) @ _AXES[:, np.newaxis]
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    return directions


def face_solid_angles(side: int) -> Floats:
    """Return what each texel of a face covers (side, side), in steradians, exactly."""
    edges = 2 * np.arange(side + 1) / side - 1
    x, y = np.meshgrid(edges, edges)
    corner = np.arctan2(x * y, np.sqrt(x * x + y * y + 1))
    solid: Floats = corner[1:, 1:] - corner[1:, :-1] - corner[:-1, 1:] + corner[:-1, :-1]
    return solid


def halved(faces: Faces) -> Faces:
    """Return faces of half the side, each texel the mean of four by their solid angles."""
    side = faces.shape[1]
    weights = face_solid_angles(side)[np.newaxis, :, :, np.newaxis]
    light = (faces * weights).reshape(6, side // 2, 2, side // 2, 2, -1).sum(axis=(2, 4))
    total = weights.reshape(1, side // 2, 2, side // 2, 2, 1).sum(axis=(2, 4))
    halves: Faces = (light / total).astype(np.float32)
    return halves


def pyramid(faces: Faces) -> Pyramid:
    """Return the levels of faces whose side is a power of two, down to one texel."""
    levels = [faces]
    while levels[-1].shape[1] > 1:
        levels.append(halved(levels[-1]))
    sides = [level.shape[1] for level in levels]
    counts = [6 * (side + 2) ** 2 for side in sides]
    texels = [with_rim(level).reshape(-1, level.shape[-1]) for level in levels]
    return Pyramid(
        np.ascontiguousarray(np.concatenate(texels), dtype=np.float32),
        np.cumsum([0, *counts[:-1]]).astype(np.int64),
        np.array(sides, np.int64),
    )


def with_rim(faces: Faces) -> Faces:
    """Return faces (6, side + 2, side + 2, channels) with a rim read from their neighbours."""
    side = faces.shape[1]
    padded = np.pad(faces, ((0, 0), (1, 1), (1, 1), (0, 0)), mode="edge")
    rim = np.ones((side + 2, side + 2), bool)
    rim[1:-1, 1:-1] = False
    directions = face_directions(side, rim=1)[:, rim].reshape(-1, 3)
    padded[:, rim] = _read_clamped(faces, directions).reshape(6, -1, faces.shape[-1])
    return padded


def located(directions: Floats) -> tuple[NDArray[np.int64], Floats, Floats]:
    """Return the face of each direction (n, 3), and s and t in -1..1 on it."""
    axis = np.abs(directions).argmax(axis=1)
    along = np.take_along_axis(directions, axis[:, np.newaxis], axis=1)[:, 0]
    face = 2 * axis + (along < 0)
    frames = _AXES[face]
    across = np.einsum("nij,nj->ni", frames[:, :2], directions) / np.abs(along)[:, np.newaxis]
    return face, across[:, 0], across[:, 1]


def _read_clamped(faces: Faces, directions: Floats) -> Floats:
    """Blend the texels round each direction, of its own face only."""
    side = faces.shape[1]
    face, s, t = located(directions)
    x, y = (np.clip((place + 1) / 2 * side - 0.5, 0, side - 1) for place in (s, t))
    left, top = (np.minimum(np.floor(place).astype(int), max(side - 2, 0)) for place in (x, y))
    right, bottom = np.minimum(left + 1, side - 1), np.minimum(top + 1, side - 1)
    across, down = (x - left)[:, np.newaxis], (y - top)[:, np.newaxis]
    upper = (1 - across) * faces[face, top, left] + across * faces[face, top, right]
    lower = (1 - across) * faces[face, bottom, left] + across * faces[face, bottom, right]
    blended: Floats = (1 - down) * upper + down * lower
    return blended


@kernel
def add_light(
    total: Floats,
    pyramid: Pyramid,
    level: float,
    x: float,
    y: float,
    z: float,
    weight: float,
) -> None:
    """Add what a pyramid shows towards (x, y, z), of any length, to three channels."""
    ax, ay, az = abs(x), abs(y), abs(z)
    if ax >= ay and ax >= az:
        face, s, t = (0, -z, -y) if x > 0 else (1, z, -y)
        longest = ax
    elif ay >= az:
        face, s, t = (2, x, z) if y > 0 else (3, x, -z)
        longest = ay
    else:
        face, s, t = (4, x, -y) if z > 0 else (5, -x, -y)
        longest = az
    last = len(pyramid.sides) - 1
    bounded = min(max(level, 0.0), float(last))
    lower = min(int(bounded), last)
    share = bounded - lower
    for step in range(2):
        part = weight * (share if step else 1 - share)
        if part == 0:
            continue
        side = pyramid.sides[lower + step]
        across = (s / longest + 1) / 2 * side + 0.5
        down = (t / longest + 1) / 2 * side + 0.5
        column, row = min(int(across), side), min(int(down), side)
        right, below = across - column, down - row
        place = pyramid.starts[lower + step] + (face * (side + 2) + row) * (side + 2) + column
        for channel in range(3):
            upper = (1 - right) * pyramid.texels[place, channel] + right * pyramid.texels[
                place + 1, channel
            ]
            place_below = place + side + 2
            under = (1 - right) * pyramid.texels[place_below, channel] + right * pyramid.texels[
                place_below + 1, channel
            ]
            total[channel] += part * ((1 - below) * upper + below * under)
