"""A texture out of focus."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.members import Texture

Radius = Annotated[float, Field(ge=0, le=1)]


class BlurSpec(TextureSpec):
    """Smooths a texture with a Gaussian that goes on around its edges."""

    source: ClassVar[str] = "Gauss; convolution theorem"
    equation: ClassVar[str] = (
        "each wave of (a, b) swings times exp(-2 pi^2 (a^2 r_u^2 + b^2 r_v^2))"
    )

    technique: Literal["blur"]
    input: Texture = Field(description="The texture that is smoothed, each channel alike.")
    radius: Annotated[list[Radius], Field(min_length=2, max_length=2)] = Field(
        default=[0.01, 0.01],
        description="Standard deviation of the Gaussian along u and v in tiles: larger is softer.",
    )

    def cost(self, pixels: int) -> Cost:
        """A Fourier transform of each channel there and back."""
        return Cost(seconds=pixels * 6e-7, bytes=pixels * 96.0)
