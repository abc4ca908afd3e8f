"""Whether a texture joins itself at its edges."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.families import TextureSpec
from api_schemas.members import Texture


class SeamsSpec(TextureSpec):
    """Shows where a texture meets its own copies, and reports how visible that is.

    The job's report has for u and v the largest difference of texels across the edge, the mean one
    of neighbours elsewhere, and the ratio of both: a few times the mean is what a texture without
    a seam has, too.
    """

    source: ClassVar[str] = "Hughes et al., 2013, section 20.4"
    equation: ClassVar[str] = (
        "max |I(0, .) - I(1, .)| / mean |I(x + dx, .) - I(x, .)|, likewise along v"
    )

    technique: Literal["seams"]
    input: Texture = Field(description="The texture that is looked at.")
    shift: bool = Field(
        default=True,
        description="Show it moved by half a tile, so that its edges meet in the middle.",
    )
