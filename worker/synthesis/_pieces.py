"""Light weighed by a lobe and added up over the sphere, far parts in larger pieces (T09, T35).

The texels of a cube are leaves of six quadtrees. A piece counts as one where it is smaller than a
share of the distance over which the lobe changes: its width plus the angle to its middle. Its light
stands where the middle of that light is, which is exact for a single bright texel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._cube import face_directions, face_solid_angles, halved
from worker.synthesis._lobes import phong, value

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis._lobes import Lobe

    Floats = NDArray[np.float64]

SHARE = 0.25
"""Of pieces; the error is then under 2 % of the mean, a sun in the sky or not."""
EVERY_TEXEL = 0.0
"""The share with which the sum is that by brute force."""

_HORIZON = 0.4  # radians; at its edge, half of the sky away, the widest lobe ends sharply


class Pieces(NamedTuple):
    """Texels of all levels of a cube, those of level k, (6, side, side), from starts[k] on.

    Of each (n, 10): where its middle is, its solid angle, where the middle of its light is, and
    that light times the solid angle.
    """

    texels: NDArray[np.float32]
    starts: NDArray[np.int64]
    sides: NDArray[np.int64]


def pieces(faces: NDArray[np.float32]) -> Pieces:
    """Take faces (6, side, side, 3) whose side is a power of two, of light that is not negative."""
    side = faces.shape[1]
    solid = face_solid_angles(side)[..., np.newaxis]
    # Of the place and of the light, so that a constant light has both in the same place
    moments = [
        face_directions(side) * np.broadcast_to(solid, (6, side, side, 1)),
        face_directions(side) * (faces.sum(axis=-1, dtype=np.float64, keepdims=True) * solid),
    ]
    texels, sides = [_texels(faces, *moments)], [side]
    while side > 1:
        faces = halved(faces)
        side //= 2
        moments = [moment.reshape(6, side, 2, side, 2, 3).sum(axis=(2, 4)) for moment in moments]
        texels.append(_texels(faces, *moments))
        sides.append(side)
    starts = np.cumsum([0, *(len(level) for level in texels[:-1])])
    return Pieces(np.concatenate(texels), starts, np.array(sides))


def sums(
    light: Pieces, lobe: Lobe, directions: Floats, share: float = SHARE
) -> NDArray[np.float32]:
    """Return the mean light (n, 3) in a lobe round each unit direction (n, 3)."""
    found = np.empty((len(directions), 3), np.float32)
    size, reach = sizes(light, lobe, share)
    _sum_all(found, light, lobe.kind, lobe.sharpness, size, reach, directions)
    return found


def sizes(light: Pieces, lobe: Lobe, share: float = SHARE) -> tuple[Floats, Floats]:
    """Return the size of each level's pieces, and the distance within which they are too large.

    That is where size > share (width + max(distance - size / 2, 0)); -1 where nowhere.
    """
    size = 2.0 / light.sides  # not less than the angle they take
    if share == EVERY_TEXEL:
        return size, np.full(len(size), np.inf)
    width = min(lobe.width, _HORIZON)
    return size, np.where(size > share * width, size / share - width + size / 2, -1.0)


def warm() -> None:
    """Compile the kernels."""
    sums(pieces(np.zeros((6, 2, 2, 3), np.float32)), phong(1.0), np.eye(3))


def _texels(faces: NDArray[np.float32], place: Floats, light: Floats) -> NDArray[np.float32]:
    side = faces.shape[1]
    middle = place / np.linalg.norm(place, axis=-1, keepdims=True)
    length = np.linalg.norm(light, axis=-1, keepdims=True)
    bright = np.divide(light, length, out=middle.copy(), where=length > 0)
    solid = np.broadcast_to(face_solid_angles(side)[..., np.newaxis], (6, side, side, 1))
    texels = np.concatenate([middle, solid, bright, faces * solid], axis=-1)
    return texels.reshape(-1, 10).astype(np.float32)


@parallel_kernel
def _sum_all(
    found: NDArray[np.float32],
    light: Pieces,
    kind: int,
    sharpness: float,
    size: Floats,
    reach: Floats,
    directions: Floats,
) -> None:
    for block in prange((len(directions) + 15) // 16):
        total = np.empty(4)
        stack = np.empty((64, 3), np.int64)
        near = np.empty(len(size))
        fill_near(near, reach, 0.0)
        for index in range(block * 16, min(block * 16 + 16, len(directions))):
            total[:] = 0.0
            add_up(total, stack, light, kind, sharpness, size, near, directions[index])
            for channel in range(3):
                found[index, channel] = total[1 + channel] / total[0]


@kernel
def next_piece(
    stack: NDArray[np.int64],
    held: int,
    face: int,
    light: Pieces,
    size: Floats,
    near: Floats,
    middle: Floats,
    spread: float,
) -> tuple[int, int]:
    """Take pieces of a face off a stack until one is small enough for some directions.

    Larger ones make way for their quarters, those that are behind all directions for nothing.

    Args:
        stack: Level, row and column of the pieces that are left, (64, 3).
        held: How many there are.
        face: Of the cube.
        light: All pieces.
        size: Of each level's.
        near: From `fill_near`.
        middle: The direction in the middle of those.
        spread: How far the others are from it.

    Returns:
        How many are left then, and which texel of `light` it is: -1 if there is none.
    """
    x, y, z = middle[0], middle[1], middle[2]
    while held > 0:
        held -= 1
        level, row, column = stack[held, 0], stack[held, 1], stack[held, 2]
        side = light.sides[level]
        at = light.starts[level] + (face * side + row) * side + column
        texels = light.texels
        cosine = x * texels[at, 0] + y * texels[at, 1] + z * texels[at, 2]
        if cosine < -size[level] - spread:
            continue
        if level == 0 or cosine <= near[level]:
            return held, at
        for child in range(4):
            stack[held, 0] = level - 1
            stack[held, 1] = 2 * row + (child >> 1)
            stack[held, 2] = 2 * column + (child & 1)
            held += 1
    return 0, -1


@kernel
def add_up(
    total: Floats,
    stack: NDArray[np.int64],
    light: Pieces,
    kind: int,
    sharpness: float,
    size: Floats,
    near: Floats,
    direction: Floats,
) -> None:
    """Add up the lobe's weight, and the light times it in three channels."""
    x, y, z = direction[0], direction[1], direction[2]
    texels = light.texels
    for face in range(6):
        stack[0, 0], stack[0, 1], stack[0, 2] = len(light.sides) - 1, 0, 0
        held, at = next_piece(stack, 1, face, light, size, near, direction, 0.0)
        while at >= 0:
            cosine = x * texels[at, 0] + y * texels[at, 1] + z * texels[at, 2]
            if cosine > 0:
                total[0] += texels[at, 3] * value(kind, sharpness, cosine)
            cosine = x * texels[at, 4] + y * texels[at, 5] + z * texels[at, 6]
            if cosine > 0:
                weight = value(kind, sharpness, cosine)
                total[1] += weight * texels[at, 7]
                total[2] += weight * texels[at, 8]
                total[3] += weight * texels[at, 9]
            held, at = next_piece(stack, held, face, light, size, near, direction, 0.0)


@kernel
def fill_near(near: Floats, reach: Floats, more: float) -> None:
    """Tell each level's cosine above which its pieces are too large, `more` added to the reach."""
    for level in range(len(reach)):
        far = reach[level] + more
        near[level] = 2.0 if reach[level] < 0 else -2.0 if far >= 2 else 1 - far * far / 2
