"""Meshes and skins."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from worker.models.gltf.document.base import Code, GltfObject, Index, Indices, Named, Real

Attributes = Annotated[dict[str, Index], Field(min_length=1)]
Weights = Annotated[list[Real], Field(min_length=1)]


class Primitive(GltfObject):
    """Vertices with one topology and one material."""

    attributes: Attributes
    indices: Index | None = None
    material: Index | None = None
    mode: Code = 4
    targets: Annotated[list[dict[str, Index]], Field(min_length=1)] | None = None


class Mesh(Named):
    """What is drawn together; weights are those of its morph targets at rest."""

    primitives: Annotated[list[Primitive], Field(min_length=1)]
    weights: Weights | None = None

    @model_validator(mode="after")
    def _one_number_of_targets(self) -> Self:
        numbers = {len(primitive.targets or ()) for primitive in self.primitives}
        if len(numbers) != 1:
            raise ValueError("primitives have different numbers of morph targets")
        if self.weights is not None and len(self.weights) not in numbers:
            raise ValueError("there are not as many weights as morph targets")
        return self


class Skin(Named):
    """Nodes that carry the vertices of a mesh."""

    inverse_bind_matrices: Index | None = None
    skeleton: Index | None = None
    joints: Indices
