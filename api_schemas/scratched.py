"""What the specs share of surfaces with fine scratches in one direction."""

from pydantic import Field

from api_schemas.maps import MappableNumber
from api_schemas.surface_spec import SurfaceSpec


class ScratchedSpec(SurfaceSpec):
    """Looks otherwise along its scratches than across them."""

    angle: MappableNumber = Field(
        default=0.0,
        description="Turns the scratches counter-clockwise, in radians, from where u grows.",
    )

    @property
    def needs_tangents(self) -> bool:
        """Scratches have a direction."""
        return True
