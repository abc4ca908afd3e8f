"""An excitable medium that settles in mazes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar, Literal

from pydantic import Field

from api_schemas.dishes import ReactionSpec, Steps
from api_schemas.parameters import MappedRate, MappedSigned

_FARTHEST = 64.0
_HALVINGS = 100


class FitzhughNagumoSpec(ReactionSpec):
    """Mazes with soft banks, or spots of either colour, from an activator and its inhibitor."""

    source: ClassVar[str] = "FitzHugh, 1961; Nagumo et al., 1962; Hagberg and Meron, 1994"
    equation: ClassVar[str] = (
        "du/dt = speed (u - u^3 - v) + diffusion_u Lap u, "
        "dv/dt = speed epsilon (u - slope v - offset) + diffusion_v Lap v"
    )
    layers: ClassVar[tuple[str, ...]] = ("u", "v")
    parameters: ClassVar[tuple[str, ...]] = (
        "speed",
        "epsilon",
        "slope",
        "offset",
        "diffusion_u",
        "diffusion_v",
    )
    spreading: ClassVar[tuple[str | None, ...]] = ("diffusion_u", "diffusion_v")

    technique: Literal["fitzhugh_nagumo"]
    speed: MappedRate = Field(
        default=0.01, description="How fast the chemicals react: slower makes wider banks."
    )
    epsilon: MappedRate = Field(
        default=3.0, description="How fast the inhibitor v follows: slow ones let waves run."
    )
    slope: MappedRate = Field(default=0.5, description="How strongly v takes itself back.")
    offset: MappedSigned = Field(
        default=0.0,
        description="Tips the balance: dark spots in light, or light in dark.",
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
        slope, offset = values["slope"], values["offset"]
        # Where both are at rest v = u - u^3: of up to three such u, one between the extremes
        low, high = -_FARTHEST, _FARTHEST
        for _ in range(_HALVINGS):
            u = (low + high) / 2
            excess = u - offset - slope * (u - u**3)
            low, high = (u, high) if excess < 0 else (low, u)
        return [u, u - u**3]

    def rates(self, state: Sequence[float], values: Mapping[str, float]) -> list[float]:
        """Return how fast each chemical changes by reaction alone."""
        (u, v), speed = state, values["speed"]
        follows = values["epsilon"] * (u - values["slope"] * v - values["offset"])
        return [speed * (u - u**3 - v), speed * follows]
