"""Two colours in squares, as far as waves of a bounded fineness show them."""

from typing import Annotated, ClassVar, Final, Literal

from pydantic import Field

from api_schemas.base import Color
from api_schemas.families import TextureSpec
from api_schemas.textures.checkerboard import Cells

FINEST_LIMIT: Final = 512
"""Harmonics from here on are never added."""


class BandLimitedCheckerboardSpec(TextureSpec):
    """Squares of two colours, made of no finer waves than a pixel, or a limit, can hold.

    Each way of leaving fine waves out shows its mark: ringing beside the edges, or softer edges.
    """

    source: ClassVar[str] = "Hughes et al., 2013, exercise 20.3"
    equation: ClassVar[str] = (
        "share of colors[0] = (1 + S(nu u) S(nv v)) / 2, "
        "S(x) = 4/pi sum of w(k/limit) sin(k pi x) / k over odd k < limit"
    )

    technique: Literal["band_limited_checkerboard"]
    cells: Annotated[list[Cells], Field(min_length=2, max_length=2)] = Field(
        default=[8, 8],
        description="Squares per tile along u and v; even numbers repeat without a seam.",
    )
    colors: Annotated[list[Color], Field(min_length=2, max_length=2)] = Field(
        default=[[0.85, 0.85, 0.85], [0.15, 0.15, 0.15]],
        description="Linear colour of the square at the lower left corner, and of its neighbours.",
    )
    window: Literal["truncated", "fejer", "lanczos", "gaussian"] = Field(
        default="lanczos",
        description="How fine waves are left out: none below the limit, which rings (truncated, "
        "w = 1); or fading, evenly and without overshoot (fejer, 1 - x), barely ringing (lanczos, "
        "sinc x), softest (gaussian, exp(-4.5 x^2)).",
    )
    band_limit: Annotated[float, Field(ge=1, le=FINEST_LIMIT)] | None = Field(
        default=None,
        description="Waves of fewer half swings per square than this are kept: 1 leaves grey, 2 "
        "one wave, 40 nearly square edges. Without it, as many as pixels can hold, 512 at most.",
    )

    def has_formula(self) -> bool:
        """Every place has its colour."""
        return True
