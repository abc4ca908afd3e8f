"""What is known at each vertex of a primitive, while it is morphed, bent and split."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from worker.geometry.mesh import UV_SETS_MAX
from worker.models.gltf.accessors import Accessors, Rows
from worker.models.gltf.document.meshes import Primitive
from worker.models.gltf.semantics import sets_of

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Vertices:
    """Vertices as glTF has them: v runs down.

    Attributes:
        positions: (n, 3).
        normals: (n, 3), of any length, if there are any.
        tangents: (n, 4), of any length, if there are any.
        uv_sets: (n, 2) each.
        colors: (n, 4), linear, straight alpha, if there are any.
    """

    positions: Floats
    normals: Floats | None
    tangents: Floats | None
    uv_sets: tuple[Floats, ...]
    colors: Floats | None

    @classmethod
    def read(cls, primitive: Primitive, accessors: Accessors, rows: Rows | None) -> Self:
        """Read a primitive's attributes.

        Args:
            primitive: With a POSITION.
            accessors: The document's.
            rows: Which of its vertices; all without.

        Raises:
            UnusableAssetError: A number is not finite, or there are no data.
        """

        def of(name: str) -> Floats | None:
            index = primitive.attributes.get(name)
            return None if index is None else accessors.numbers(index, rows)

        sets = sets_of(list(primitive.attributes), "TEXCOORD")[:UV_SETS_MAX]
        colors = of("COLOR_0")
        if colors is not None and colors.shape[1] == 3:
            colors = np.column_stack([colors, np.ones(len(colors))])
        return cls(
            positions=accessors.numbers(primitive.attributes["POSITION"], rows),
            normals=of("NORMAL"),
            tangents=of("TANGENT"),
            uv_sets=tuple(
                accessors.numbers(primitive.attributes[f"TEXCOORD_{n}"], rows) for n in sets
            ),
            colors=colors,
        )

    def taken(self, rows: Rows) -> Self:
        """Return the vertices in another order, or several times."""

        def take(values: Floats | None) -> Floats | None:
            return None if values is None else values[rows]

        return replace(
            self,
            positions=self.positions[rows],
            normals=take(self.normals),
            tangents=take(self.tangents),
            uv_sets=tuple(uv[rows] for uv in self.uv_sets),
            colors=take(self.colors),
        )


def morphed(
    vertices: Vertices,
    primitive: Primitive,
    weights: list[float],
    accessors: Accessors,
    rows: Rows | None,
) -> Vertices:
    """Add the displacements of the morph targets, each times its weight.

    Raises:
        UnusableAssetError: A displacement is not finite.
    """
    sums: dict[str, Floats] = {}
    for target, weight in zip(primitive.targets or (), weights, strict=True):
        if weight == 0:
            continue
        for name, index in target.items():
            if name.startswith("_"):
                continue
            moved = weight * accessors.numbers(index, rows)
            sums[name] = sums[name] + moved if name in sums else moved

    def plus(name: str, values: Floats) -> Floats:
        if name not in sums:
            return values
        result = values.copy()
        result[:, : sums[name].shape[1]] += sums[name]
        return result

    normals, tangents, colors = vertices.normals, vertices.tangents, vertices.colors
    return replace(
        vertices,
        positions=plus("POSITION", vertices.positions),
        normals=None if normals is None else plus("NORMAL", normals),
        tangents=None if tangents is None else plus("TANGENT", tangents),
        uv_sets=tuple(plus(f"TEXCOORD_{n}", uv) for n, uv in enumerate(vertices.uv_sets)),
        colors=None if colors is None else plus("COLOR_0", colors),
    )
