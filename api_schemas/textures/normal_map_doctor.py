"""What is wrong with a normal map."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.cost import Cost
from api_schemas.normal_reading import NormalReadingSpec


class NormalMapDoctorSpec(NormalReadingSpec):
    """Asks whether a normal map belongs to a relief; shows the normals of the nearest one.

    The report tells `not_integrable`, the share of the slopes' energy that no relief has, and
    `not_integrable_flipped`, the same with green turned round; by these, whether `green` is
    `as_said`, `flipped` or `cannot_tell`; `curl` with its `rms` and `largest` amount; the
    `circulation` counter-clockwise round a loop, which is 0 on every relief; the mean slopes
    (`tilt`); the `length` of the normals (`least`, `mean`, `largest`), and `not_upwards`, the share
    that points below the surface. Layers: curl (of the slopes, per tile), height (in tiles, mean
    0), and residual, the slope that is left beside the nearest relief's.
    """

    source: ClassVar[str] = (
        "Frankot and Chellappa, 1988; Hughes et al., 2013, inline exercise 20.2 (non-integrable "
        "normals)"
    )
    equation: ClassVar[str] = (
        "curl = dq/du - dp/dv with slopes p = -n_x/n_z, q = -n_y/n_z; circulation = the integral "
        "of p du + q dv round the loop"
    )
    layers: ClassVar[tuple[str, ...]] = ("curl", "height", "residual")

    technique: Literal["normal_map_doctor"]
    green: Literal["up", "down"] = Field(
        default="up", description="What is believed: green grows with v, as in OpenGL, or against."
    )
    loop_radius: Annotated[float, Field(ge=0, le=0.5)] = Field(
        default=0.25, description="Radius in tiles of the loop round the middle of the tile."
    )
    range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Components of the picture's normals from -1..1 packed into 0..1, or as they "
        "are.",
    )

    def cost(self, pixels: int) -> Cost:
        """A dozen Fourier transforms."""
        return Cost(seconds=pixels * 2e-6, bytes=pixels * 320.0)
