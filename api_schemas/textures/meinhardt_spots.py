"""An activator that feeds its own inhibitor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.dishes import ReactionSpec, Steps
from api_schemas.parameters import MappedRate

_HALVINGS = 100


class MeinhardtSpotsSpec(ReactionSpec):
    """Scattered spots, like a leopard cub, around sources that are not quite alike."""

    source: ClassVar[str] = "Gierer and Meinhardt, 1972; Meinhardt, 1982; Turk, 1991"
    equation: ClassVar[str] = (
        "da/dt = speed (.01 a^2 beta / b - decay_a a + base) + diffusion_a Lap a, "
        "db/dt = speed (.01 a^2 beta - decay_b b + base) + diffusion_b Lap b"
    )
    layers: ClassVar[tuple[str, ...]] = ("a", "b")
    parameters: ClassVar[tuple[str, ...]] = (
        "speed",
        "beta",
        "decay_a",
        "decay_b",
        "base",
        "diffusion_a",
        "diffusion_b",
    )
    spreading: ClassVar[tuple[str | None, ...]] = ("diffusion_a", "diffusion_b")

    technique: Literal["meinhardt_spots"]
    speed: MappedRate = Field(
        default=0.2, description="How fast the chemicals react: slower makes larger spots."
    )
    beta: MappedRate = Field(default=1.0, description="How much a the sources make.")
    decay_a: MappedRate = Field(default=0.03, description="How fast the activator a is taken out.")
    decay_b: MappedRate = Field(
        default=0.04,
        description="How fast the inhibitor b is taken out: patterns need it faster than a.",
    )
    base: MappedRate = Field(default=0.0, description="How much of both flows in everywhere.")
    diffusion_a: MappedRate = Field(
        default=0.01, description="How fast a spreads, in squared cells per unit of time."
    )
    diffusion_b: MappedRate = Field(
        default=0.2, description="How fast b spreads: patterns need it much faster than a."
    )
    irregularity: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.1,
        description="By how much beta is off from cell to cell: what the pattern grows from.",
    )
    disturbance: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.0, description="By what share the start is off from rest, at random."
    )
    steps: Steps = Field(
        default=5000, description="For how long the chemicals react: patterns spread and settle."
    )
    chemical: Literal["a", "b"] = Field(
        default="a", description="Which chemical is shown; each is a layer."
    )

    def shown(self) -> str:
        """Return the chemical of the picture."""
        return self.chemical

    def rest(self, values: Mapping[str, float]) -> list[float] | None:
        """Return the steady state without diffusion."""
        beta, base = 0.01 * values["beta"], values["base"]
        decay_a, decay_b = values["decay_a"], values["decay_b"]
        if not (beta > 0 and decay_a > 0 and decay_b > 0):
            return None
        # b has to be what either equation makes it: one is too small below the root, one above
        low, high = base / decay_a, (base + decay_b) / decay_a + 1
        for _ in range(_HALVINGS):
            a = (low + high) / 2
            excess = (beta * a * a + base) * (decay_a * a - base) - decay_b * beta * a * a
            low, high = (a, high) if excess < 0 else (low, a)
        return [a, (beta * a * a + base) / decay_b]

    def rates(self, state: Sequence[float], values: Mapping[str, float]) -> list[float]:
        """Return how fast each chemical changes by reaction alone."""
        (a, b), speed, base = state, values["speed"], values["base"]
        made = 0.01 * a * a * values["beta"]
        return [
            speed * (made / b - values["decay_a"] * a + base),
            speed * (made - values["decay_b"] * b + base),
        ]
