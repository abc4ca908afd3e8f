"""What a scene would draw and hold, counted from the JSON before any number is read."""

from collections.abc import Iterable

from worker.geometry.mesh import UV_SETS_MAX
from worker.models.gltf.document.meshes import Primitive
from worker.models.gltf.document.root import Document
from worker.models.gltf.faults import too_large
from worker.models.gltf.limits import (
    MORPHED_VERTICES_MAX,
    PARTS_MAX,
    VERTEX_BYTES_MAX,
)
from worker.models.gltf.semantics import sets_of
from worker.models.gltf.topology import KINDS, count_of
from worker.models.limits import TRIANGLES_MAX, VERTICES_MAX


class Budget:
    """Counts what is asked for and refuses what is too much."""

    def __init__(self, document: Document) -> None:
        """Begin with nothing."""
        self._document = document
        self._parts = self._drawn = self._vertices = self._bytes = self._morphed = 0

    def draw(self, primitives: Iterable[Primitive]) -> None:
        """Count a mesh at one more place.

        Raises:
            UnusableAssetError: `asset_too_large`.
        """
        for primitive in primitives:
            self._parts += 1
            self._drawn += count_of(primitive.mode, self._indices(primitive))
        _check(self._parts, PARTS_MAX, "draws")
        _check(self._drawn, TRIANGLES_MAX, "triangles, lines and points")

    def hold(self, primitives: Iterable[Primitive], weights: Iterable[float]) -> None:
        """Count a mesh in one more pose.

        Raises:
            UnusableAssetError: `asset_too_large`.
        """
        targets = sum(weight != 0 for weight in weights)
        for primitive in primitives:
            vertices = min(self._indices(primitive), self._count(primitive))
            self._morphed += targets * vertices
            if KINDS[primitive.mode] == "triangles" and "NORMAL" not in primitive.attributes:
                vertices = 3 * count_of(primitive.mode, self._indices(primitive))
            self._vertices += vertices
            self._bytes += vertices * _bytes_of_one(primitive)
        _check(self._vertices, VERTICES_MAX, "vertices")
        _check(self._bytes, VERTEX_BYTES_MAX, "bytes of vertices")
        _check(self._morphed, MORPHED_VERTICES_MAX, "vertices times morph targets")

    def _indices(self, primitive: Primitive) -> int:
        if primitive.indices is not None:
            return self._document.accessors[primitive.indices].count
        return self._count(primitive)

    def _count(self, primitive: Primitive) -> int:
        position = primitive.attributes.get("POSITION")
        return 0 if position is None else self._document.accessors[position].count


def _bytes_of_one(primitive: Primitive) -> int:
    """Return what a vertex occupies: its position and normal, and what else it brings."""
    sets = min(len(sets_of(list(primitive.attributes), "TEXCOORD")), UV_SETS_MAX)
    fours = sum(name in primitive.attributes for name in ("TANGENT", "COLOR_0"))
    return 8 * (6 + 2 * sets + 4 * fours)


def _check(count: int, most: int, what: str) -> None:
    if count > most:
        raise too_large("/scenes", f"{count} {what}; at most {most} are taken")
