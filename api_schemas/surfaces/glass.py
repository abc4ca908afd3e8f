"""Glass, as thick as nobody sees its other side."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.maps import MappableColor, MappableNonNegative
from api_schemas.surface_spec import SurfaceSpec


class GlassSpec(SurfaceSpec):
    """Reflects its surroundings and shows them bent: refraction mapping.

    It sees the scene's environment and ambient light, not the things behind it; light is bent once,
    where it is seen. From inside, light leaves the glass, as far as it can.
    """

    source: ClassVar[str] = (
        "Snell's and Fresnel's laws; as maps of the environment: Blinn and Newell, 1976; Hughes et "
        "al., 2013, table 20.1"
    )
    equation: ClassVar[str] = (
        "L_out = F L(r) + (1 - F) color L(t), sin(i) = ior sin(t), "
        "F = ((g - c) / (g + c))^2 (1 + ((c (g + c) - 1) / (c (g - c) + 1))^2) / 2, "
        "c = n.v, g^2 = ior^2 - 1 + c^2"
    )

    technique: Literal["glass"]
    color: MappableColor = Field(
        default=[1.0, 1.0, 1.0], description="Linear colour of what is seen through it."
    )
    ior: Annotated[float, Field(ge=1, le=10)] = Field(
        default=1.5,
        description="Index of refraction: higher bends and reflects more; 1 is not there at all.",
    )
    roughness: MappableNonNegative = Field(
        default=0.0, description="How blurred both are, from clear (0) to frosted (1)."
    )

    @property
    def sky_lookups(self) -> int:
        """One is reflected, one bent."""
        return 2
