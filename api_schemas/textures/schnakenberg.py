"""The simplest two chemicals that make spots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.dishes import ReactionSpec, Steps
from api_schemas.parameters import MappedRate


class SchnakenbergSpec(ReactionSpec):
    """Even spots in a honeycomb from the simplest reaction that makes any."""

    source: ClassVar[str] = "Schnakenberg, 1979"
    equation: ClassVar[str] = (
        "du/dt = speed (a - u + u^2 v) + diffusion_u Lap u, "
        "dv/dt = speed (b - u^2 v) + diffusion_v Lap v"
    )
    layers: ClassVar[tuple[str, ...]] = ("u", "v")
    parameters: ClassVar[tuple[str, ...]] = ("speed", "a", "b", "diffusion_u", "diffusion_v")
    spreading: ClassVar[tuple[str | None, ...]] = ("diffusion_u", "diffusion_v")

    technique: Literal["schnakenberg"]
    speed: MappedRate = Field(
        default=0.0125, description="How fast the chemicals react: slower makes larger spots."
    )
    a: MappedRate = Field(default=0.1, description="How fast u flows in.")
    b: MappedRate = Field(
        default=0.9, description="How fast v flows in: with less of it spots become stripes."
    )
    diffusion_u: MappedRate = Field(
        default=0.01, description="How fast u spreads, in squared cells per unit of time."
    )
    diffusion_v: MappedRate = Field(
        default=0.2, description="How fast v spreads: patterns need it much faster than u."
    )
    steps: Steps = Field(
        default=6000, description="For how long the chemicals react: patterns spread and settle."
    )
    chemical: Literal["u", "v"] = Field(
        default="u", description="Which chemical is shown; each is a layer."
    )

    def shown(self) -> str:
        """Return the chemical of the picture."""
        return self.chemical

    def rest(self, values: Mapping[str, float]) -> list[float] | None:
        """Return the steady state without diffusion."""
        total = values["a"] + values["b"]
        return [total, values["b"] / total**2] if total > 0 else None

    def rates(self, state: Sequence[float], values: Mapping[str, float]) -> list[float]:
        """Return how fast each chemical changes by reaction alone."""
        (u, v), speed = state, values["speed"]
        made = u * u * v
        return [speed * (values["a"] - u + made), speed * (values["b"] - made)]
