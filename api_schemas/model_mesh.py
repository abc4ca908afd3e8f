"""An uploaded model in the place of a mesh: with its own nodes, materials, cameras and lights."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from api_schemas.base import WHOLE, Schema, Sha256
from api_schemas.surface_spec import Surface

PartName = Annotated[str, Field(max_length=256)]
PartIndex = Annotated[int, Field(ge=0, le=2**31 - 1), WHOLE]


def _json_type(value: object) -> str:
    return "name" if isinstance(value, str) else "index"


Part = Annotated[
    Annotated[PartName, Tag("name")] | Annotated[PartIndex, Tag("index")],
    Discriminator(_json_type),
]
"""A node, a material or a camera of a model: by its name in the file, or by its index there."""


class MaterialChange(Schema):
    """Another surface in the place of one of the model's materials."""

    material: Part = Field(
        description="Which material: all of this name, or the one at this index, from 0."
    )
    surface: Surface = Field(description="What it becomes.")


class NodeChange(Schema):
    """A change to one of the model's nodes."""

    node: Part = Field(
        description="Which node: all of this name, or the one at this index, from 0."
    )
    visible: bool = Field(
        default=True, description="Whether the node's own mesh is drawn; its children still are."
    )
    surface: Surface | None = Field(
        default=None, description="How its mesh reflects light, instead of its materials."
    )


class ModelMesh(Schema):
    """An uploaded model: glTF, GLB, OBJ, PLY or STL.

    It brings its own nodes and materials, and its cameras and lights where the scene has none.
    """

    type: Literal["model"]
    asset: Sha256 = Field(description="The model's SHA-256, as its upload answered.")
    files: dict[Annotated[str, Field(min_length=1, max_length=256)], Sha256] = Field(
        default={},
        max_length=256,
        description="The uploads that the model speaks of: its buffers, pictures and material "
        "libraries, by the names that its upload's `files` told. More than it needs may be given.",
    )
    scene: Annotated[int, Field(ge=0, le=65535), WHOLE] | None = Field(
        default=None, description="Which of the file's scenes; the one it names as its own without."
    )
    materials: Annotated[list[MaterialChange], Field(max_length=256)] = Field(
        default=[],
        description="Materials to be replaced; of two changes of the same one the later counts.",
    )
    nodes: Annotated[list[NodeChange], Field(max_length=256)] = Field(
        default=[],
        description="Nodes to be changed; of two changes of the same one the later counts.",
    )
