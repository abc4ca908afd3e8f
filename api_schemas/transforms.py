"""Where things stand: translation, rotation and scale, or one matrix."""

from typing import Annotated

from pydantic import Discriminator, Field, Tag

from api_schemas.base import Coordinate, Matrix4, Schema, Vector

Quaternion = Annotated[list[Coordinate], Field(min_length=4, max_length=4)]


class Placement(Schema):
    """Scales, then turns, then moves."""

    translation: Vector = Field(default=[0.0, 0.0, 0.0], description="Shift along x, y and z.")
    rotation: Quaternion = Field(
        default=[0.0, 0.0, 0.0, 1.0],
        description="Turn as a quaternion x, y, z, w, of any length but zero.",
    )
    scale: Vector = Field(default=[1.0, 1.0, 1.0], description="Stretch along x, y and z.")


class MatrixPlacement(Schema):
    """One matrix for everything."""

    matrix: Matrix4 = Field(
        description="Sixteen numbers, column by column, as in glTF; the last row is 0 0 0 1."
    )


def by_key(key: str) -> Discriminator:
    """Choose between two shapes by the presence of a key, so that a mistake is told once."""

    def choose(value: object) -> str:
        present = key in value if isinstance(value, dict) else hasattr(value, key)
        return f"with {key}" if present else f"without {key}"

    return Discriminator(choose)


Transform = Annotated[
    Annotated[Placement, Tag("without matrix")] | Annotated[MatrixPlacement, Tag("with matrix")],
    by_key("matrix"),
]
