"""How much a rough surface reflects of light from everywhere: the table of split sums."""

from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.families import Meaning, TextureSpec


class DfgSpec(TextureSpec):
    """Reflectance of microfacets, over the cosine of the viewing angle (u) and the roughness (v).

    Red is A, green is B: under a uniform sky of radiance 1, what reflects F0 of light that falls on
    it head-on shows F0 A + B. Blue is A + B, what is left of all light after one bounce; the rest
    bounces on between the microfacets.
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
