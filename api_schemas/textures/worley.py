"""Cells around scattered points."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class WorleySpec(TextureSpec):
    """Stones, scales, cracks and bubbles: how far the nearest scattered points are."""

    source: ClassVar[str] = "Worley, 1996"
    equation: ClassVar[str] = "F_k(p) = distance from frequency p to its k-th nearest point"
    meaning: ClassVar[Meaning] = "data"
    revision: ClassVar[int] = 2
    solid: ClassVar[bool] = True

    technique: Literal["worley"]
    frequency: Annotated[int, Field(ge=1, le=1024), WHOLE] = Field(
        default=8, description="Cells per tile along each side: larger is finer."
    )
    points: Literal["one", "poisson"] = Field(
        default="one",
        description="One point in each cell, evenly spread, or as chance has it, one on average.",
    )
    jitter: Annotated[float, Field(ge=0, le=1)] = Field(
        default=1.0,
        description="How far points stray from the middle of their cells: 0 is a square grid. "
        "Only where each cell has one point.",
    )
    metric: Literal["euclidean", "manhattan", "chebyshev"] = Field(
        default="euclidean",
        description="How distance is measured: round cells, cells of diamonds, cells of squares.",
    )
    output: Literal["f1", "f2", "difference"] = Field(
        default="f1",
        description="Distance to the nearest point (bubbles), to the second one, or how much "
        "farther the second one is (cells with dark borders); in cells, rarely above 1.",
    )
    seed: Seed = Field(default=0, description="Another number, other points.")

    def has_formula(self) -> bool:
        """Always."""
        return True

    def cost(self, pixels: int) -> Cost:
        """About twenty points are looked at for each pixel, and every cell makes its own."""
        return Cost(
            seconds=pixels * 2e-7 + self.frequency**2 * 2e-7,
            bytes=pixels * 8.0 + self.frequency**2 * 64.0,
        )

    def volume_cost(self, voxels: int) -> Cost:
        """About eighty points are looked at for each voxel, and every cube makes its own."""
        return Cost(
            seconds=voxels * 6e-7 + self.frequency**3 * 4e-7,
            bytes=voxels * 8.0 + self.frequency**3 * 96.0,
        )
