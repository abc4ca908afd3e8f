"""What a rough mirror sees of all directions."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.sphere_textures import SphereTextureSpec

Roughness = Annotated[float, Field(ge=0, le=1)]
Exponent = Annotated[float, Field(ge=0, le=1e6)]
PANELS_MAX = 12
_TEXELS_IN_A_LOBE = 6.0
_SECONDS_PER_TEXEL = 2e-8


class PrefilteredEnvironmentSpec(SphereTextureSpec):
    """Light blurred by the lobe of a rough surface: one look-up in the place of an integral.

    For one roughness it is a picture; for several they stand on each other, the first on top, each
    half as wide and high as the one above, as levels of a mip chain. The lobe is that of a surface
    seen head-on, where the look-up is exact; the report tells how far each is from the sum over all
    texels.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Heidrich and Seidel, 1999; Karis, 2013; Krivanek and Colbert, 2008"
    equation: ClassVar[str] = (
        "L(r) = int L(w) D(w, r) dw / int D(w, r) dw, D = D V n.l of GGX for n = v = r, or "
        "max(0, w.r)^n"
    )

    cube_side: ClassVar[int] = 96

    technique: Literal["prefiltered_environment"]
    roughness: Annotated[list[Roughness], Field(min_length=1, max_length=PANELS_MAX)] = Field(
        default=[0.5], description="Of each picture, from a mirror (0) to dull (1)."
    )
    exponents: Annotated[list[Exponent], Field(max_length=PANELS_MAX)] = Field(
        default=[],
        description="Lobes of Phong's model in the place of roughness, when there are any: 0 sees "
        "half of the sky alike, larger is sharper.",
    )
    method: Literal["pieces", "sum"] = Field(
        default="pieces",
        description="Far parts of the sky in larger pieces, or the sum over all texels for every "
        "pixel, which is slow.",
    )
    show: Literal["light", "error"] = Field(
        default="light",
        description="The picture, or how far it is from the sum over all texels.",
    )

    @property
    def surface_size(self) -> tuple[int, int]:
        """Twice as high where there are panels below the first."""
        width, height = super().surface_size
        panels = len(self.exponents or self.roughness)
        return (width, height if panels == 1 else 2 * height)

    def cost(self, pixels: int) -> Cost:
        """A thousand pieces of the sky for every pixel, or all texels of a cube."""
        exact = self.method == "sum" or self.show == "error"
        seconds = self._texels * _SECONDS_PER_TEXEL if exact else 1.5e-5
        return Cost(seconds=0.5 + pixels * seconds, bytes=pixels * 128.0 + 2e8)

    @property
    def _texels(self) -> int:
        """Of the cube that is as fine as the narrowest lobe needs."""
        widths = [1 / math.sqrt(exponent + 1) for exponent in self.exponents]
        narrowest = min(
            widths or [roughness**2 for roughness in self.roughness if roughness > 0.01] or [1.0]
        )
        useful = min(max(_TEXELS_IN_A_LOBE * math.pi / 2 / narrowest, 64), 512)
        side = 1 << math.ceil(math.log2(useful))
        return 6 * side * side
