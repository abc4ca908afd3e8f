"""The light that arrives on a matt surface, for every way it may face."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import Number
from api_schemas.cost import Cost
from api_schemas.maps import COLOUR
from api_schemas.members import Texture
from api_schemas.own_size import OWN_SIZE
from api_schemas.sphere_textures import SphereSpec

Coefficient = Annotated[list[Number], Field(min_length=3, max_length=3)]


class IrradianceSpec(SphereSpec):
    """Irradiance over pi at every direction of a normal: what a white matt surface shows there.

    The job's report tells the nine coefficients of the light and how far they miss the sum over
    all texels; and whether the light comes from below, as in a picture stored upside down.
    """

    revision: ClassVar[int] = 2
    source: ClassVar[str] = "Ramamoorthi and Hanrahan, 2001; Sloan et al., 2002; Miller, 1984"
    equation: ClassVar[str] = (
        "E(n) / pi = (1 / pi) int L(w) max(0, n.w) dw ~ sum_lm (A_l / pi) L_lm Y_lm(n), "
        "A = pi, 2 pi / 3, pi / 4"
    )

    cube_side: ClassVar[int] = 48

    technique: Literal["irradiance"]
    environment: Annotated["Texture | None", OWN_SIZE, COLOUR] = Field(
        default=None,
        description="The light: an upload with its own pixels, or any technique. Alpha is ignored; "
        "what is below zero is dark. Without one the coefficients are taken.",
    )
    coefficients: Annotated[list[Coefficient], Field(min_length=9, max_length=9)] = Field(
        default=[[0.0, 0.0, 0.0]] * 9,
        description="Red, green and blue of L00, L1-1, L10, L11, L2-2, L2-1, L20, L21, L22, where "
        "there is no environment: L1-1 is along y, L10 along z, L11 along x.",
    )
    method: Literal["harmonics", "sum"] = Field(
        default="harmonics",
        description="Nine smooth functions, at once and within a few percent, or the sum over all "
        "texels for each pixel, exact and slow.",
    )

    def cost(self, pixels: int) -> Cost:
        """The sum goes over pieces of the sky for every pixel."""
        return Cost(
            seconds=0.3 + pixels * (1.5e-5 if self.method == "sum" else 5e-7),
            bytes=pixels * 200.0 + 1e8,
        )
