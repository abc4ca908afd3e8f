"""Texture sewn together from square patches."""

from typing import ClassVar, Literal

from api_schemas.sewn import SewnSpec


class ImageQuiltingSpec(SewnSpec):
    """Sews squares of the exemplar together along the seams that are seen least."""

    source: ClassVar[str] = "Efros and Freeman, 2001"
    equation: ClassVar[str] = (
        "E(i, j) = |new - old|^2(i, j) + min(E(i - 1, j - 1), E(i - 1, j), E(i - 1, j + 1))"
    )

    technique: Literal["image_quilting"]
