"""Textures that chemicals leave in a dish of grid cells: what all of them have in common."""

import itertools
from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Seed
from api_schemas.cost import Cost
from api_schemas.eigenvalues import eigenvalues
from api_schemas.families import Meaning, Refusal, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture
from api_schemas.parameters import MappedSigned, ParameterMap, ends

# Only names of the language are quoted: who inherits a field knows no others.

Side = Annotated[int, Field(ge=16, le=2048), WHOLE]
Steps = Annotated[int, Field(ge=0, le=100000), WHOLE]

_CORNERS_MAX = 64
_CHECKERBOARD = 8.0
"""What the five-point Laplacian takes from a checkerboard, the wave that it damps most."""


class CellsSpec(TextureSpec):
    """Grid cells that change step by step: how many, how long, and what is at their rim."""

    meaning: ClassVar[Meaning] = "data"
    sized: ClassVar[bool] = True
    parameters: ClassVar[tuple[str, ...]] = ()
    """The fields that may be textures, as the equations need them."""
    seconds_per_cell: ClassVar[float] = 1e-8
    """One core's time for one step of one cell."""

    size: Annotated[list[Side], Field(min_length=2, max_length=2)] = Field(
        default=[256, 256],
        description="Width and height of the dish in grid cells: a larger one holds more pattern.",
    )
    steps: Steps = Field(
        default=5000,
        description="For how long the chemicals react: patterns spread and settle.",
    )
    border: Literal["torus", "no_flux", "fixed"] = Field(
        default="torus",
        description="What is beyond the edges: the opposite edge, which makes a seamless tile, a "
        "wall, or the dish at rest for ever.",
    )
    still_below: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.0,
        description="Stop before the last step once no cell changes faster than this, per unit "
        "of time; 0 never does.",
    )

    def inner_size(self, size: tuple[int, int]) -> tuple[int, int]:
        """Textures within are made cell by cell."""
        return self.size[0], self.size[1]

    def cost(self, pixels: int) -> Cost:
        """Every step passes over every cell of the dish, then it is brought to the size asked."""
        cells = self.size[0] * self.size[1]
        chemicals = len(self.layers) or 4
        seconds = cells * (self.steps + 10) * self.seconds_per_cell + self.steps * 4e-5
        held = 48.0 * chemicals + 8.0 * len(self.parameters) + 64.0
        return Cost(seconds + pixels * chemicals * 2e-8, cells * held + pixels * 16.0)


class DishSpec(CellsSpec):
    """A dish of chemicals: what it starts from, too."""

    start: Annotated["Texture | None", DATA] = Field(
        default=None,
        description="What to begin from: channels are chemicals in their order, and those that it "
        "has no channel for are at rest. A later state follows from the layers of an earlier one.",
    )
    mask: Annotated["Texture | None", DATA] = Field(
        default=None,
        description="Where the start is disturbed and how much: its first channel, 0 not at all, "
        "1 fully.",
    )
    seed: Seed = Field(default=0, description="Another number, another pattern of the same kind.")


class ReactionSpec(DishSpec):
    """Chemicals that react and spread by explicit steps in float64, from near their rest."""

    spreading: ClassVar[tuple[str | None, ...]] = ()
    """The parameter by which each chemical spreads, in squared cells per unit of time."""

    time_step: Annotated[float, Field(ge=1e-4, le=10)] = Field(
        default=1.0, description="How far one step leads: longer is faster, until it is unstable."
    )
    disturbance: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.01,
        description="By what share the start is off from rest, at random: what patterns grow from.",
    )
    across: Annotated[float, Field(ge=0, le=1)] = Field(
        default=1.0,
        description="How fast chemicals spread across the direction, as a share of how fast along "
        "it: below 1 spots grow long and stripes fall into line.",
    )
    direction: MappedSigned = Field(
        default=0.0,
        description="The direction in radians, counter-clockwise from u, where across is not 1.",
    )
    guide: Annotated["Texture | None", DATA] = Field(
        default=None,
        description="A texture along whose edges they spread: `direction` then counts from them.",
    )
    guide_radius: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.02,
        description="How far around a point the edges of the guide are looked at, in tiles.",
    )
    range: Literal["stretched", "raw"] = Field(
        default="stretched",
        description="Whether the picture leads from the least value to the greatest, or holds the "
        "numbers themselves; layers always do.",
    )

    @abstractmethod
    def shown(self) -> str:
        """Return the chemical of the picture."""

    @abstractmethod
    def rest(self, values: Mapping[str, float]) -> list[float] | None:
        """Return the steady state without diffusion, or None where there is none."""

    @abstractmethod
    def rates(self, state: Sequence[float], values: Mapping[str, float]) -> list[float]:
        """Return how fast each chemical changes by reaction alone."""

    def middle(self) -> dict[str, float]:
        """Return the parameters, each in the middle of its range."""
        return {name: sum(ends(getattr(self, name))) / 2 for name in self.parameters}

    def refusals(self) -> Iterator[Refusal]:
        """Tell of parameters that have no rest, and of steps too long to be stable there.

        Each parameter that is a texture is taken at both ends of its range.
        """
        bound = float("inf")
        for values in self._corners():
            state = self.rest(values)
            if state is None:
                names = ", ".join(f"{name} {value:g}" for name, value in values.items())
                yield Refusal("no_steady_state", "", f"nothing is at rest with {names}")
                return
            bound = min(bound, self._longest_step(state, values))
        if self.time_step > bound:
            yield Refusal(
                "time_step_unstable",
                "time_step",
                f"steps of {self.time_step:g} are unstable with this reaction and diffusion; "
                f"the longest stable one is {bound:.6g}",
            )

    def _corners(self) -> Iterator[dict[str, float]]:
        choices = [sorted(set(ends(getattr(self, name)))) for name in self.parameters]
        for corner in itertools.islice(itertools.product(*choices), _CORNERS_MAX):
            yield dict(zip(self.parameters, corner, strict=True))

    def _longest_step(self, state: Sequence[float], values: Mapping[str, float]) -> float:
        """Return the step h beyond which |1 + h lambda| > 1 for something that should fade.

        Both the whole dish, which feels reaction alone, and a checkerboard are looked at; what
        grows (Re lambda > 0) is a pattern and no mistake of the step.
        """
        jacobian = self._jacobian(state, values)
        bound = float("inf")
        for taken in (0.0, _CHECKERBOARD):
            matrix = [list(row) for row in jacobian]
            for index, name in enumerate(self.spreading):
                matrix[index][index] -= taken * values[name] if name else 0.0
            for value in eigenvalues(matrix):
                if value.real < -1e-9 * abs(value):
                    bound = min(bound, -2 * value.real / abs(value) ** 2)
        return bound

    def _jacobian(self, state: Sequence[float], values: Mapping[str, float]) -> list[list[float]]:
        columns = []
        for index, value in enumerate(state):
            near = 1e-6 * (1 + abs(value))
            pair = []
            for side in (value - near, value + near):
                moved = [*state[:index], side, *state[index + 1 :]]
                pair.append(self.rates(moved, values))
            columns.append([(b - a) / (2 * near) for a, b in zip(*pair, strict=True)])
        return [list(row) for row in zip(*columns, strict=True)]


def mapped(spec: CellsSpec, name: str) -> ParameterMap | None:
    """Return the map that is in the place of a parameter, if one is."""
    value = getattr(spec, name)
    return value if isinstance(value, ParameterMap) else None
