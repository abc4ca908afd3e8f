"""Chemicals that oscillate or stand in stripes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.dishes import ReactionSpec, Steps
from api_schemas.parameters import MappedRate


class BrusselatorSpec(ReactionSpec):
    """Spots or stripes of high contrast, or beating waves, as feed and turnover have it."""

    source: ClassVar[str] = "Prigogine and Lefever, 1968"
    equation: ClassVar[str] = (
        "du/dt = speed (a - (b + 1) u + u^2 v) + diffusion_u Lap u, "
        "dv/dt = speed (b u - u^2 v) + diffusion_v Lap v"
    )
    layers: ClassVar[tuple[str, ...]] = ("u", "v")
    parameters: ClassVar[tuple[str, ...]] = ("speed", "a", "b", "diffusion_u", "diffusion_v")
    spreading: ClassVar[tuple[str | None, ...]] = ("diffusion_u", "diffusion_v")

    technique: Literal["brusselator"]
    speed: MappedRate = Field(
        default=0.0045, description="How fast the chemicals react: slower makes larger patterns."
    )
    a: MappedRate = Field(default=4.5, description="How fast u flows in.")
    b: MappedRate = Field(
        default=7.5,
        description="How fast u turns into v: little stays even, more makes spots, most beats.",
    )
    diffusion_u: MappedRate = Field(
        default=0.025, description="How fast u spreads, in squared cells per unit of time."
    )
    diffusion_v: MappedRate = Field(
        default=0.2, description="How fast v spreads: patterns need it much faster than u."
    )
    steps: Steps = Field(
        default=8000, description="For how long the chemicals react: patterns spread and settle."
    )
    chemical: Literal["u", "v"] = Field(
        default="u", description="Which chemical is shown; each is a layer."
    )

    def shown(self) -> str:
        """Return the chemical of the picture."""
        return self.chemical

    def rest(self, values: Mapping[str, float]) -> list[float] | None:
        """Return the steady state without diffusion."""
        return [values["a"], values["b"] / values["a"]] if values["a"] > 0 else None

    def rates(self, state: Sequence[float], values: Mapping[str, float]) -> list[float]:
        """Return how fast each chemical changes by reaction alone."""
        (u, v), speed = state, values["speed"]
        made, turned = u * u * v, values["b"] * u
        return [speed * (values["a"] - turned - u + made), speed * (turned - made)]
