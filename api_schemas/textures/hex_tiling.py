"""An exemplar laid without end in pieces that are blended sharply."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import GrownSpec
from api_schemas.cost import Cost


class HexTilingSpec(GrownSpec):
    """Lays pieces from random places of an exemplar, turned by chance, over each other's edges.

    As quick as by_example_noise and sharper, and what is light wins; its histogram does not stay.
    For sand, grass, gravel from far away. It always tiles.
    """

    source: ClassVar[str] = "Mikkelsen, 2022; Heitz and Neyret, 2018 (the triangles)"
    equation: ClassVar[str] = (
        "sum w_i c_i / sum w_i, w_i = b_i^sharpness (1 - contrast + contrast luminance(c_i)), "
        "b the barycentric coordinates"
    )
    layers: ClassVar[tuple[str, ...]] = ()

    technique: Literal["hex_tiling"]
    piece: Annotated[int, Field(ge=1, le=1024), WHOLE] = Field(
        default=48,
        description="Pixels between the middles of pieces, at most half the exemplar, or a third "
        "if they are turned: larger ones keep larger things, and show them as often.",
    )
    rotation: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0,
        description="How far pieces are turned by chance: 0 not at all, 1 in any direction. "
        "Pixels are then means of up to four.",
    )
    sharpness: Annotated[float, Field(ge=1, le=64)] = Field(
        default=7, description="How narrow the blends between pieces are: 1 is wide and blurred."
    )
    contrast: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.6,
        description="How much what is light wins where pieces are blended: it keeps grains whole.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Three pieces are looked up and blended for each pixel."""
        grown = self.size[0] * self.size[1]
        return Cost(
            seconds=grown * 2.5e-6 + within["exemplar"] * 1e-7 + pixels * 5e-8,
            bytes=grown * 480.0 + within["exemplar"] * 60.0 + pixels * 64.0,
        )
