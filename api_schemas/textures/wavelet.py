"""Noise that keeps to its octave."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class WaveletSpec(TextureSpec):
    """Tileable noise in sharply separated bands: fine detail that neither blurs nor aliases."""

    source: ClassVar[str] = "Cook and DeRose, 2005"
    equation: ClassVar[str] = (
        "sum_b gain^b N_b(2^b (u, v)) / sqrt(V sum_b gain^2b), N = R - upsample(downsample(R))"
    )
    meaning: ClassVar[Meaning] = "data"

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
        "filter, 0.269936.",
    )
    range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Four standard deviations reach from 0.5 to 1, or from 0 to 1.",
    )
    seed: Seed = Field(default=0, description="Another number, another pattern.")

    def cost(self, pixels: int) -> Cost:
        """Each band has four times the coefficients of the last, at most as many as pixels."""
        coefficients = min(4 * self.frequency**2 * 4 ** (self.bands - 1), pixels)
        return Cost(
            seconds=coefficients * 2e-7 + pixels * 1e-8 * self.bands,
            bytes=coefficients * 48.0 + pixels * 4.0,
        )
