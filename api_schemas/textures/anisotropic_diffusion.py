"""A texture that spreads faster in one direction than in the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.dishes import CellsSpec, Steps
from api_schemas.families import Refusal
from api_schemas.maps import DATA
from api_schemas.members import Texture
from api_schemas.parameters import MappedRate, MappedSigned, ends


class AnisotropicDiffusionSpec(CellsSpec):
    """Draws a texture out along directions that differ from place to place: fur, wood, rust.

    The picture is the texture after the last step, every channel alike.
    """

    source: ClassVar[str] = "Kass and Witkin, 1991; Weickert, 1998 (directions of a picture)"
    equation: ClassVar[str] = (
        "dC/dt = div(D grad C) - dissipation C + inflow, "
        "D = R(direction) diag(along, across) R(direction)^T"
    )
    parameters: ClassVar[tuple[str, ...]] = (
        "along",
        "across",
        "direction",
        "dissipation",
        "inflow",
    )

    technique: Literal["anisotropic_diffusion"]
    input: Texture = Field(description="What spreads.")
    along: MappedRate = Field(
        default=0.2,
        description="How fast it spreads along the direction, in squared cells per unit of time.",
    )
    across: MappedRate = Field(
        default=0.002, description="How fast it spreads across the direction, likewise."
    )
    direction: MappedSigned = Field(
        default=0.0, description="The direction in radians, counter-clockwise from u."
    )
    guide: Annotated[Texture | None, DATA] = Field(
        default=None,
        description="A texture along whose edges it spreads: `direction` then counts from them.",
    )
    guide_radius: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.02,
        description="How far around a point the edges of the guide are looked at, in tiles.",
    )
    dissipation: MappedRate = Field(default=0.0, description="How fast it fades, per unit of time.")
    inflow: MappedSigned = Field(default=0.0, description="How much is added per unit of time.")
    time_step: Annotated[float, Field(ge=1e-4, le=10)] = Field(
        default=1.0, description="How far one step leads: longer is faster, until it is unstable."
    )
    steps: Steps = Field(default=200, description="For how long it spreads.")

    def refusals(self) -> Iterator[Refusal]:
        """Tell of steps beyond 2 / (8 d + dissipation), d the faster of both ways to spread.

        No wave loses more than that in any field of directions.
        """
        fastest = max(ends(self.along)[1], ends(self.across)[1])
        lost = 8 * fastest + ends(self.dissipation)[1]
        if self.time_step * lost > 2:
            yield Refusal(
                "time_step_unstable",
                "time_step",
                f"steps of {self.time_step:g} are unstable with this diffusion and dissipation; "
                f"the longest stable one is {2 / lost:.6g}",
            )
