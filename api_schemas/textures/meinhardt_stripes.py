"""Two activators that keep each other at arm's length."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.dishes import ReactionSpec, Steps
from api_schemas.parameters import MappedRate


class MeinhardtStripesSpec(ReactionSpec):
    """Stripes like a zebra's, from two activators that each need the other near but not here."""

    source: ClassVar[str] = "Meinhardt, 1982; Turk, 1991"
    equation: ClassVar[str] = (
        "da/dt = .01 a^2 e beta / c - decay a + diffusion_a Lap a, "
        "db/dt = .01 b^2 d / c - decay b + diffusion_a Lap b, "
        "dc/dt = .01 a^2 e beta + .01 b^2 d - decay_c c, "
        "dd/dt = (a - d) follow + diffusion_d Lap d, "
        "de/dt = (b - e) follow + diffusion_d Lap e"
    )
    layers: ClassVar[tuple[str, ...]] = ("a", "b", "c", "d", "e")
    parameters: ClassVar[tuple[str, ...]] = (
        "beta",
        "decay",
        "decay_c",
        "follow",
        "diffusion_a",
        "diffusion_d",
    )
    spreading: ClassVar[tuple[str | None, ...]] = (
        "diffusion_a",
        "diffusion_a",
        None,
        "diffusion_d",
        "diffusion_d",
    )

    technique: Literal["meinhardt_stripes"]
    beta: MappedRate = Field(
        default=1.0,
        description="How much a the sources make; away from 1 one kind of stripe is wider.",
    )
    decay: MappedRate = Field(default=0.04, description="How fast both activators are taken out.")
    decay_c: MappedRate = Field(
        default=0.06, description="How fast the inhibitor c, common to both, is taken out."
    )
    follow: MappedRate = Field(
        default=0.04, description="How fast the messengers d and e take after a and b."
    )
    diffusion_a: MappedRate = Field(
        default=0.009, description="How fast a and b spread, in squared cells per unit of time."
    )
    diffusion_d: MappedRate = Field(
        default=0.2, description="How fast the messengers spread: faster makes wider stripes."
    )
    irregularity: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.05,
        description="By how much beta is off from cell to cell: what the pattern grows from.",
    )
    disturbance: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.0, description="By what share the start is off from rest, at random."
    )
    steps: Steps = Field(
        default=8000, description="For how long the chemicals react: patterns spread and settle."
    )
    chemical: Literal["a", "b", "c", "d", "e"] = Field(
        default="a", description="Which chemical is shown; each is a layer."
    )

    def shown(self) -> str:
        """Return the chemical of the picture."""
        return self.chemical

    def rest(self, values: Mapping[str, float]) -> list[float] | None:
        """Return the steady state without diffusion."""
        decay, decay_c = values["decay"], values["decay_c"]
        if not (decay > 0 and decay_c > 0):
            return None
        a = decay_c / (2 * decay)
        return [a, a, 0.01 * a * a / decay, a, a]

    def rates(self, state: Sequence[float], values: Mapping[str, float]) -> list[float]:
        """Return how fast each chemical changes by reaction alone."""
        a, b, c, d, e = state
        made_a, made_b = 0.01 * a * a * e * values["beta"], 0.01 * b * b * d
        decay, follow = values["decay"], values["follow"]
        return [
            made_a / c - decay * a,
            made_b / c - decay * b,
            made_a + made_b - values["decay_c"] * c,
            (a - d) * follow,
            (b - e) * follow,
        ]
