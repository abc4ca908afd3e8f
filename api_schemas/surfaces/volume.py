"""Clouds, smoke and murky water: what is in a box and lets light through."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, NonNegative
from api_schemas.maps import MappableColor, MappableDensity
from api_schemas.surface_spec import SurfaceSpec


class VolumeSpec(SurfaceSpec):
    """Fills a box with something that takes, scatters and gives off light, like a cloud.

    Rays are followed through the box in even steps; light is scattered once, weakened on its way in
    by what lies before it. What stands inside the box is seen as if it stood behind it.
    """

    source: ClassVar[str] = (
        "Beer, 1852; Lambert, 1760; Kajiya and Von Herzen, 1984; Henyey and Greenstein, 1941"
    )
    equation: ClassVar[str] = (
        "T(t) = exp(-int_0^t s), s = extinction density, "
        "L_out = T(L) L_behind + int_0^L T s (emission + color (La + sum_l p T_l E_l)) dt, "
        "p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)), g = anisotropy"
    )
    fills_box: ClassVar[bool] = True

    technique: Literal["volume"]
    alpha_mode: Literal["blend"] = Field(
        default="blend", description="What is behind always shows through."
    )
    density: MappableDensity = Field(
        default=1.0, description="How much there is at each place; what is below 0 is nothing."
    )
    extinction: NonNegative = Field(
        default=1.0,
        description="How much light a density of 1 takes on each unit of length in the world: "
        "exp(-extinction length) is left.",
    )
    color: MappableColor = Field(
        default=[1.0, 1.0, 1.0],
        description="Which part of the light that is taken is scattered, and not lost; a map is "
        "read where the ray enters.",
    )
    emission: MappableColor = Field(
        default=[0.0, 0.0, 0.0],
        description="Linear radiance of it by itself, where so much of it is that one cannot look "
        "through: fire.",
    )
    anisotropy: Annotated[float, Field(ge=-0.99, le=0.99)] = Field(
        default=0.0,
        description="Where light is scattered to: on (towards 1: bright rims of clouds before the "
        "sun), back (towards -1), or everywhere alike (0).",
    )
    steps: Annotated[int, Field(ge=1, le=256), WHOLE] = Field(
        default=64, description="Steps of each ray: more show finer detail and no bands."
    )
    light_steps: Annotated[int, Field(ge=0, le=32), WHOLE] = Field(
        default=8,
        description="Steps from each of these towards each light: what shades itself looks round; "
        "0 lets all light in.",
    )

    def looks(self, lights: int) -> int:
        """Every step looks at the density, and so does every step towards a light."""
        return 1 + self.steps * (1 + lights * self.light_steps)
