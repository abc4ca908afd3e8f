"""Plain-Python vectors and matrices: enough to tell a usable transform from a degenerate one.

Matrices are three columns of the linear part and a translation, all of three numbers.
"""

import math
from dataclasses import dataclass

from api_schemas.transforms import MatrixPlacement, Placement

Vector3 = tuple[float, float, float]

LARGEST_STRETCH = 1e9
SMALLEST_STRETCH = 1e-9
FLATTEST = 1e-9


@dataclass(frozen=True, slots=True)
class Affine:
    """A world-from-local map: the images of the x, y and z axes, and of the origin."""

    x: Vector3
    y: Vector3
    z: Vector3
    origin: Vector3

    def turn(self, v: Vector3) -> Vector3:
        """Apply the linear part."""
        return (
            self.x[0] * v[0] + self.y[0] * v[1] + self.z[0] * v[2],
            self.x[1] * v[0] + self.y[1] * v[1] + self.z[1] * v[2],
            self.x[2] * v[0] + self.y[2] * v[1] + self.z[2] * v[2],
        )

    def __matmul__(self, inner: "Affine") -> "Affine":
        moved = self.turn(inner.origin)
        origin = (
            moved[0] + self.origin[0],
            moved[1] + self.origin[1],
            moved[2] + self.origin[2],
        )
        return Affine(self.turn(inner.x), self.turn(inner.y), self.turn(inner.z), origin)

    def is_degenerate(self) -> bool:
        """Whether the axes have fallen together, vanished or left the range of float32."""
        stretches = [length(axis) for axis in (self.x, self.y, self.z)]
        if not all(SMALLEST_STRETCH <= s <= LARGEST_STRETCH for s in stretches):
            return True
        if not length(self.origin) <= LARGEST_STRETCH:
            return True
        volume = abs(dot(self.x, cross(self.y, self.z)))
        return not volume > FLATTEST * math.prod(stretches)


IDENTITY = Affine((1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0))


def dot(a: Vector3, b: Vector3) -> float:
    """Return the inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector3, b: Vector3) -> Vector3:
    """Return the vector product."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def length(a: Vector3) -> float:
    """Return the Euclidean length."""
    return math.hypot(*a)


def triple(numbers: list[float]) -> Vector3:
    """Return three numbers of a list as a vector."""
    x, y, z = numbers
    return (x, y, z)


def affine(placement: Placement | MatrixPlacement) -> Affine | None:
    """Return the map a transform means, or None where there is none (zero turn, not affine)."""
    if isinstance(placement, MatrixPlacement):
        m = placement.matrix
        if m[3:16:4] != [0, 0, 0, 1]:
            return None
        return Affine(triple(m[0:3]), triple(m[4:7]), triple(m[8:11]), triple(m[12:15]))
    norm = math.hypot(*placement.rotation)
    if norm == 0:
        return None
    x, y, z, w = (q / norm for q in placement.rotation)
    sx, sy, sz = placement.scale
    return Affine(
        (sx * (1 - 2 * (y * y + z * z)), sx * 2 * (x * y + z * w), sx * 2 * (x * z - y * w)),
        (sy * 2 * (x * y - z * w), sy * (1 - 2 * (x * x + z * z)), sy * 2 * (y * z + x * w)),
        (sz * 2 * (x * z + y * w), sz * 2 * (y * z - x * w), sz * (1 - 2 * (x * x + y * y))),
        triple(placement.translation),
    )
