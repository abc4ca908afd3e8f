"""Noise that keeps to its octave."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Angle, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class WaveletSpec(TextureSpec):
    """Tileable noise in sharply separated bands: fine detail that neither blurs nor aliases.

    A slice of solid noise leaks into coarser bands; projected onto the plane, it hardly does.
    """

    source: ClassVar[str] = "Cook and DeRose, 2005"
    equation: ClassVar[str] = (
        "sum_b gain^b N_b(2^b (u, v)) / sqrt(V sum_b gain^2b), N = R - upsample(downsample(R))"
    )
    meaning: ClassVar[Meaning] = "data"
    solid: ClassVar[bool] = True

    technique: Literal["wavelet"]
    frequency: Annotated[int, Field(ge=1, le=1024), WHOLE] = Field(
        default=16, description="Finest swings per tile of the first band: larger is finer."
    )
    bands: Annotated[int, Field(ge=1, le=12), WHOLE] = Field(
        default=1,
        description="Layers, each twice as fine as the one before; those finer than two pixels "
        "fade away.",
    )
    gain: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.5, description="How much of its strength each band keeps: larger is rougher."
    )
    normalization: Literal["paper", "exact"] = Field(
        default="exact",
        description="Divide by the variance printed in the paper, 0.265, or by that of its "
        "filter, 0.269936; of a solid 0.21 or 0.195606, projected 0.296 or 0.30531.",
    )
    cut: Literal["plane", "slice", "projected"] = Field(
        default="plane",
        description="What a picture shows: noise of the plane, a bare slice of the solid, or the "
        "solid projected onto a plane through it.",
    )
    depth: Annotated[float, Field(ge=-1024, le=1024)] = Field(
        default=0.0, description="How deep in the solid the plane's middle lies, in tiles."
    )
    tilt: Annotated[list[Angle], Field(min_length=2, max_length=2)] = Field(
        default=[0.0, 0.0],
        description="How the plane in the solid leans: its normal's angle to w, and that angle's "
        "direction, from u to v. What leans does not repeat.",
    )
    range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Four standard deviations reach from 0.5 to 1, or from 0 to 1.",
    )
    seed: Seed = Field(default=0, description="Another number, another pattern.")

    def cost(self, pixels: int) -> Cost:
        """Each band has four times the coefficients of the last, at most as many as pixels."""
        if self.cut != "plane":
            return self._from_solid(pixels, pixels**0.5)
        coefficients = min(4 * self.frequency**2 * 4 ** (self.bands - 1), pixels)
        return Cost(
            seconds=coefficients * 2e-7 + pixels * 1e-8 * self.bands,
            bytes=coefficients * 48.0 + pixels * 4.0,
        )

    def volume_cost(self, voxels: int) -> Cost:
        """The same with eight times the coefficients."""
        return self._from_solid(voxels, voxels ** (1 / 3))

    def _from_solid(self, pixels: int, side: float) -> Cost:
        coefficients = min(2 * self.frequency * 2 ** (self.bands - 1), side) ** 3
        leaning = {"plane": 2e-7, "slice": 6e-7, "projected": 1e-5}[self.cut]
        return Cost(
            seconds=coefficients * 4e-7 + pixels * (leaning if self.tilt[0] else 2e-7) * self.bands,
            bytes=coefficients * 64.0 + pixels * 8.0,
        )
