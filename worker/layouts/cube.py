"""The faces of a cube round the middle of the world (Greene, 1986).

Along the largest of |x|, |y|, |z| lies the face; the others, over it, are the place on it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.layouts._axes import AXES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.layouts.cube import CubeSpec

    Numbers = NDArray[np.float64]

_FACES = tuple(AXES)
_RINGS = {"openexr": ("-x", "-z", "+x", "+z"), "gl": ("-x", "+z", "+x", "-z")}
"""The faces round y, from left to right."""


def cells(spec: CubeSpec) -> dict[str, tuple[int, int, bool]]:
    """Return column and row of each face from the upper left, and whether it is on its head."""
    ring = _RINGS[spec.orientation]
    match spec.arrangement:
        case "column":
            return {face: (0, row, False) for row, face in enumerate(_FACES)}
        case "row":
            return {face: (column, 0, False) for column, face in enumerate(_FACES)}
        case "cross":
            middle = {face: (column, 1, False) for column, face in enumerate(ring)}
            return {"+y": (1, 0, False), "-y": (1, 2, False)} | middle
        case "tall_cross":
            middle = {face: (column, 1, False) for column, face in enumerate(ring[:3])}
            return {"+y": (1, 0, False), "-y": (1, 2, False), ring[3]: (1, 3, True)} | middle


def sides(spec: CubeSpec) -> dict[str, Numbers]:
    """Return the rows right, up and forward of each face, (3, 3), as it lies on the picture."""
    found = {}
    for face, (_, _, on_its_head) in cells(spec).items():
        forward, right, up = (np.array(axis, dtype=np.float64) for axis in AXES[face])
        if spec.orientation == "gl":
            # As seen from outside: mirrored, and above and below turned.
            right, up = (right, -up) if face[1] == "y" else (-right, up)
        turn = -1.0 if on_its_head else 1.0
        found[face] = np.stack([turn * right, turn * up, forward])
    return found


def place(spec: CubeSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions."""
    largest = np.abs(directions).argmax(axis=1)
    positive = directions[np.arange(len(directions)), largest] >= 0
    columns, rows = spec.proportion
    uv = np.empty((len(directions), 2))
    faces = sides(spec)
    for face, (column, row, _) in cells(spec).items():
        there = (largest == "xyz".index(face[1])) & (positive == (face[0] == "+"))
        right, up, forward = (directions[there] @ faces[face].T).T
        uv[there, 0] = (column + 0.5 + 0.5 * right / forward) / columns
        uv[there, 1] = 1 - (row + 0.5 - 0.5 * up / forward) / rows
    return uv


def direction(spec: CubeSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the unit directions at places, and which places are on a face."""
    columns, rows = spec.proportion
    across, down = uv[:, 0] * columns, (1 - uv[:, 1]) * rows
    column = np.clip(np.floor(across), 0, columns - 1)
    row = np.clip(np.floor(down), 0, rows - 1)
    local = np.stack([2 * (across - column) - 1, 1 - 2 * (down - row), np.ones(len(uv))], axis=1)
    local /= np.linalg.norm(local, axis=1, keepdims=True)
    found, valid = np.empty((len(uv), 3)), np.zeros(len(uv), bool)
    found[:] = local @ next(iter(sides(spec).values()))
    for face, (face_column, face_row, _) in cells(spec).items():
        there = (column == face_column) & (row == face_row)
        found[there] = local[there] @ sides(spec)[face]
        valid |= there
    return found, valid


def solid_angles(spec: CubeSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel, exact: A = atan(x y / sqrt(x^2 + y^2 + 1)) of corners.

    Texels that lie on several faces count for all of them.
    """
    columns, rows = spec.proportion
    across, down = np.arange(width + 1) * columns / width, np.arange(height + 1) * rows / height
    found = np.zeros((height, width))
    for column, row, _ in cells(spec).values():
        x, y = np.meshgrid(
            np.clip(2 * (across - column) - 1, -1, 1), np.clip(2 * (down - row) - 1, -1, 1)
        )
        corners = np.arctan2(x * y, np.sqrt(x * x + y * y + 1))
        found += np.diff(np.diff(corners, axis=0), axis=1)
    return found


def faces_of_opengl(spec: CubeSpec, pixels: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Cut a picture into the faces +x, -x, +y, -y, +z, -z of a cube map, each with t = 0 on top.

    Args:
        spec: How they lie on it.
        pixels: (height, width, channels), as many squares as the arrangement has.
    """
    side = pixels.shape[1] // spec.proportion[0]
    wanted = sides(spec.model_copy(update={"arrangement": "row", "orientation": "gl"}))
    faces = []
    for face in _FACES:
        column, row, _ = cells(spec)[face]
        cell = pixels[row * side : (row + 1) * side, column * side : (column + 1) * side]
        right, up, _ = (sides(spec)[face] * wanted[face]).sum(axis=1)
        faces.append(cell[:: int(up), :: int(right)])
    return faces
