"""What is known of an uploaded file: measured once, then trusted by costs and by validation."""

from typing import Annotated, Literal, TypeAlias

from pydantic import Field, TypeAdapter

from api_schemas.base import WHOLE, Number, Schema, Sha256

Positive = Annotated[int, Field(ge=1, le=2**53), WHOLE]
Count = Annotated[int, Field(ge=0, le=2**53), WHOLE]
Names = list[Annotated[str, Field(max_length=256)]]
Corner = Annotated[list[Number], Field(min_length=3, max_length=3)]


class _Facts(Schema):
    sha256: Sha256 = Field(description="SHA-256 of the file's bytes: the asset's name.")
    media_type: Annotated[str, Field(max_length=64)] = Field(
        description="Media type by the file's content, whatever the upload called it."
    )
    format: Annotated[str, Field(max_length=16)] = Field(
        description="File format by content: png, openexr, jpeg, glb and so on."
    )
    bytes: Count = Field(description="Length of the file.")


class ImageFacts(_Facts):
    """An uploaded picture, named by the hash of its bytes."""

    kind: Literal["image"] = Field(description="What the file holds.")
    width: Positive = Field(description="Pixels from left to right.")
    height: Positive = Field(description="Pixels from top to bottom.")
    channels: Annotated[int, Field(ge=1, le=4), WHOLE] = Field(
        description="How many numbers a pixel has."
    )
    bits: Literal[8, 16, 32] = Field(description="Bits of each of these numbers.")
    float: bool = Field(description="Whether they are floating point numbers.")
    has_alpha: bool = Field(description="Whether the last channel is coverage.")


class ModelFacts(_Facts):
    """An uploaded model, with what can be told without the files it speaks of."""

    kind: Literal["model"] = Field(description="What the file holds.")
    triangles: Count = Field(description="How many triangles it draws.")
    lines: Count = Field(description="How many lines it draws.")
    points: Count = Field(description="How many points it draws.")
    vertices: Count = Field(description="How many vertices these have.")
    draws: Count = Field(description="How many meshes with one material each it draws.")
    bounds_min: Corner | None = Field(description="Lowest x, y, z of its default scene, if any.")
    bounds_max: Corner | None = Field(description="Highest x, y, z of its default scene, if any.")
    uv_sets: Count = Field(description="How many sets of texture coordinates it has at most.")
    has_normals: bool = Field(description="Whether it brings normals.")
    has_tangents: bool = Field(description="Whether it brings tangents.")
    has_vertex_colors: bool = Field(description="Whether its vertices have colours.")
    materials: Names = Field(description="Its materials by index; an empty name where it has none.")
    nodes: Names = Field(description="Its nodes by index.")
    cameras: Names = Field(description="The cameras of its default scene by index.")
    scenes: Count = Field(
        default=0, description="How many scenes it has; without any, all of it is drawn."
    )
    lights: Count = Field(description="How many lights its default scene brings.")
    texels: Count = Field(description="Pixels of the pictures inside it.")
    files: Names = Field(description="Names of the files it needs beside it.")
    warnings: Names = Field(description="What it asks for and will not get.")


class BufferFacts(_Facts):
    """Numbers that a glTF file speaks of; their meaning is told there."""

    kind: Literal["buffer"] = Field(description="What the file holds.")


class MaterialLibraryFacts(_Facts):
    """Materials that an OBJ file speaks of."""

    kind: Literal["material_library"] = Field(description="What the file holds.")
    materials: Names = Field(description="Its materials.")
    files: Names = Field(description="Names of the pictures they need.")


AssetFacts: TypeAlias = Annotated[
    ImageFacts | ModelFacts | BufferFacts | MaterialLibraryFacts, Field(discriminator="kind")
]
"""What is known of an asset."""

ASSET_FACTS: TypeAdapter[AssetFacts] = TypeAdapter(AssetFacts)
"""Reads what is known of an asset."""
