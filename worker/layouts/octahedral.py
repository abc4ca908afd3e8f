"""Directions on an octahedron, unfolded into a square (Praun and Hoppe, 2003)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.layouts._density import sum_of_parts

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.layouts.octahedral import OctahedralSpec

    Numbers = NDArray[np.float64]


def place(spec: OctahedralSpec, directions: Numbers) -> Numbers:
    """Return (u, v) of directions."""
    on_octahedron = directions / np.abs(directions).sum(axis=1, keepdims=True)
    below = on_octahedron[:, 2:] < 0
    return 0.5 + 0.5 * np.where(below, _folded(on_octahedron[:, :2]), on_octahedron[:, :2])


def direction(spec: OctahedralSpec, uv: Numbers) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return the unit directions at places; every place holds one."""
    found = _on_octahedron(uv)
    return found / np.linalg.norm(found, axis=1, keepdims=True), np.ones(len(uv), bool)


def solid_angles(spec: OctahedralSpec, width: int, height: int) -> Numbers:
    """Return the solid angle of each texel, by parts of it.

    A face of the octahedron is 1 / sqrt(3) away and leans so that the square has 1 / sqrt(3) of its
    area: 1 / r^3 steradians per area of the square at a distance r.
    """
    return sum_of_parts(
        lambda uv: 4 / np.linalg.norm(_on_octahedron(uv), axis=1) ** 3, width, height
    )


def _on_octahedron(uv: Numbers) -> Numbers:
    flat = 2 * uv - 1
    height = 1 - np.abs(flat).sum(axis=1)
    across = np.where(height[:, np.newaxis] < 0, _folded(flat), flat)
    return np.column_stack([across, height])


def _folded(flat: Numbers) -> Numbers:
    """Fold the corners of the square to its middle, and back."""
    return (1 - np.abs(flat[:, ::-1])) * np.where(flat < 0, -1.0, 1.0)
