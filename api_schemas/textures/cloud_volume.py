"""A solid cloud, looked through."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Color
from api_schemas.cost import Cost
from api_schemas.families import Refusal, TextureSpec, textures_in
from api_schemas.maps import DATA_IN_SPACE
from api_schemas.members import Texture
from api_schemas.solid import flat_parts

if TYPE_CHECKING:
    from collections.abc import Iterator


class CloudVolumeSpec(TextureSpec):
    """A tile full of cloud seen from its front: puffs that shade themselves, or an opacity map.

    Light comes from above. Nothing is scattered twice.
    """

    source: ClassVar[str] = "Gardner, 1985; Kajiya and Von Herzen, 1984"
    equation: ClassVar[str] = (
        "1 - exp(-extinction integral density dw); color integral T extinction density "
        "(dark + (lit - dark) exp(-shade integral density dv)) dw, T = exp(-extinction integral)"
    )

    technique: Literal["cloud_volume"]
    density: Annotated[Texture, DATA_IN_SPACE] = Field(
        default={
            "technique": "levels",
            "input": {"technique": "perlin", "frequency": 3, "octaves": 5},
            "input_range": [0.5, 0.75],
        },
        validate_default=True,
        description="A solid texture whose first channel says how dense the cloud is; what is "
        "below 0 counts as clear air.",
    )
    extinction: Annotated[float, Field(ge=0, le=10000)] = Field(
        default=12.0, description="How opaque a density of 1 is, all the way through the tile."
    )
    shade: Annotated[float, Field(ge=0, le=10000)] = Field(
        default=6.0, description="How dark a density of 1 above makes what lies below."
    )
    reach: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.3, description="From how far above shadows fall, in tiles."
    )
    lit: Color = Field(default=[1.0, 0.98, 0.94], description="Linear colour in full light.")
    dark: Color = Field(default=[0.16, 0.19, 0.26], description="Linear colour in shadow.")
    show: Literal["cloud", "opacity"] = Field(
        default="cloud",
        description="The cloud with alpha, or how much of what is behind it hides, as data.",
    )
    steps: Annotated[int, Field(ge=1, le=1024), WHOLE] = Field(
        default=64, description="Slices that are looked through: more show thinner wisps."
    )

    def refusals(self) -> Iterator[Refusal]:
        """Tell what in the density does not fill space."""
        for place, part in flat_parts(self.density, "density"):
            yield Refusal("texture_not_solid", place, f"{part.technique} does not fill space")

    def cost(self, pixels: int) -> Cost:
        """The density as a volume, and a few exponentials for each voxel."""
        voxels = pixels * self.steps
        inside = sum((part.volume_cost(voxels) for part in textures_in(self.density)), Cost())
        return inside + Cost(seconds=voxels * 4e-8, bytes=pixels * 64.0)
