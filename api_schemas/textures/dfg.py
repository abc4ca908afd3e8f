"""How much a rough surface reflects of light that comes from everywhere: the table of split sums."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class DfgSpec(TextureSpec):
    """Directional reflectance of microfacets: u is the cosine of the viewing angle, v the roughness.

    Red is A, green is B: under a uniform sky of radiance 1 a surface of reflectance F0 seen head-on
    shows F0 A + B. Blue is A + B, what a perfect mirror shows after one bounce; the rest of it has
    bounced more than once between the microfacets.
    """

    source: ClassVar[str] = "Karis, 2013; Walter et al., 2007 (GGX); Heitz, 2014 (shadowing)"
    equation: ClassVar[str] = (
        "A = int f (1 - (1 - v.h)^5) n.l dl, B = int f (1 - v.h)^5 n.l dl, "
        "f = D V of GGX with height-correlated Smith shadowing, alpha = v^2"
    )
    meaning: ClassVar[Meaning] = "data"
    surface_side: ClassVar[int] = 64

    technique: Literal["dfg"]
    span: Literal["centres", "edges"] = Field(
        default="centres",
        description="What the outermost pixels show: the middle of their own area, as everywhere "
        "in a picture, or the very ends 0 and 1, for reading between pixels up to there.",
    )

    def cost(self, pixels: int) -> Cost:
        """An integral at every pixel."""
        return Cost(seconds=pixels * 2e-5, bytes=pixels * 16.0)
