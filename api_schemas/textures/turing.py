"""Chemicals as Turing imagined them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.dishes import ReactionSpec, Steps
from api_schemas.parameters import MappedRate


class TuringSpec(ReactionSpec):
    """Spots and short stripes, as Turing explained them: what pigments leave on a hide."""

    source: ClassVar[str] = "Turing, 1952; Turk, 1991"
    equation: ClassVar[str] = (
        "da/dt = speed (16 - a b) + diffusion_a Lap a, "
        "db/dt = speed (a b - b - beta) + diffusion_b Lap b, b >= 0"
    )
    layers: ClassVar[tuple[str, ...]] = ("a", "b")
    parameters: ClassVar[tuple[str, ...]] = ("speed", "beta", "diffusion_a", "diffusion_b")
    spreading: ClassVar[tuple[str | None, ...]] = ("diffusion_a", "diffusion_b")

    technique: Literal["turing"]
    speed: MappedRate = Field(
        default=0.0125, description="How fast the chemicals react: slower makes larger spots."
    )
    beta: MappedRate = Field(
        default=12.0, description="How fast b is taken out; 16 and more leave nothing at rest."
    )
    diffusion_a: MappedRate = Field(
        default=0.125, description="How fast a spreads, in squared cells per unit of time."
    )
    diffusion_b: MappedRate = Field(
        default=0.03125,
        description="How fast b spreads: patterns need it slower than a fourth or so of a.",
    )
    irregularity: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.1,
        description="By how much beta is off from cell to cell: what the pattern grows from.",
    )
    disturbance: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.0, description="By what share the start is off from rest, at random."
    )
    steps: Steps = Field(
        default=10000, description="For how long the chemicals react: patterns spread and settle."
    )
    chemical: Literal["a", "b"] = Field(
        default="b", description="Which chemical is shown; each is a layer."
    )

    def shown(self) -> str:
        """Return the chemical of the picture."""
        return self.chemical

    def rest(self, values: Mapping[str, float]) -> list[float] | None:
        """Return the steady state without diffusion."""
        b = 16 - values["beta"]
        return [16 / b, b] if b > 0 else None

    def rates(self, state: Sequence[float], values: Mapping[str, float]) -> list[float]:
        """Return how fast each chemical changes by reaction alone."""
        (a, b), speed = state, values["speed"]
        return [speed * (16 - a * b), speed * (a * b - b - values["beta"])]
