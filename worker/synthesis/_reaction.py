"""Reactions from near their rest, by explicit steps, until they are done, still, or out of hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from worker.errors import RenderError
from worker.images.image import Image
from worker.outcome import Outcome
from worker.stages import silent
from worker.synthesis._directions import angles_of, spread_along, tensors_along
from worker.synthesis._dish import (
    dish_at,
    fill_rim,
    noise,
    parameter_rows,
    rows_of,
    spread,
    with_rim,
)
from worker.synthesis._pointwise import held
from worker.synthesis._resample import resample

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from api_schemas.dishes import DishSpec, ReactionSpec
    from worker.preview import Progress
    from worker.synthesis._dish import Cells, Rows

    React: TypeAlias = "Callable[[Cells, Cells, tuple[Rows, ...], float], None]"

_STEPS_PER_LOOK = 64
"""Steps between two looks at how far it is and how fast it changes: what a cancelled job waits."""
_TOO_MUCH = 1e12
_NOTHING = 1e-9
_USE_OF_PARAMETERS = 100


class Reaction:
    """A dish before its first step, and the parameters of every cell.

    Attributes:
        spec: What was asked for.
        cells: (chemicals, height + 2, width + 2).
        parameters: As the spec names them.
        tensors: How much slower everything spreads in some directions, or None.
    """

    def __init__(self, spec: ReactionSpec, inputs: Mapping[str, Image]) -> None:
        """Set up the dish at rest, in the middle of each parameter, and disturb it."""
        rest = spec.rest(spec.middle())
        if rest is None:
            raise RenderError("nothing is at rest with these parameters", code="no_steady_state")
        self.spec = spec
        self.cells = dish_at(spec, rest, inputs)
        self.parameters = parameter_rows(spec, inputs)
        self.tensors = None
        if spec.across < 1:
            direction = rows_of(spec, "direction", inputs)
            angle = angles_of(spec, direction, inputs.get("guide"), spec.guide_radius)
            self.tensors = tensors_along(angle, 1.0, spec.across, spec.border)
        width, height = spec.size
        amount = np.full((height, width), spec.disturbance)
        if "mask" in inputs:
            amount *= np.clip(mask_of(spec, inputs["mask"]), 0, 1)
        if amount.any():
            for use, level in enumerate(rest):
                # What is not there at rest is disturbed by a share of one
                off = amount * (abs(level) if abs(level) > _NOTHING else 1.0)
                self.cells[use, 1:-1, 1:-1] += off * noise(spec, use)

    def vary(self, name: str, amount: float) -> None:
        """Make a parameter up to `amount` less or more from cell to cell, never below 0."""
        if amount:
            varied = self.parameters[name][:, 1:-1] + amount * noise(self.spec, _USE_OF_PARAMETERS)
            self.parameters[name] = with_rim(np.maximum(varied, 0))


def mask_of(spec: DishSpec, image: Image) -> Cells:
    """Return the first channel of a picture at the size of the dish, (height, width)."""
    return resample(image.pixels[..., :1], (spec.size[0], spec.size[1]))[..., 0].astype(np.float64)


def run(reaction: Reaction, react: React, report: Progress = silent) -> tuple[Cells, int, float]:
    """Take the steps: each chemical spreads, then `react` adds what reaction makes of it.

    The dish so far is shown at each look but the last one.

    Returns:
        The cells, how many steps were taken, and how fast the fastest chemical changed at the last
        look, per unit of time.

    Raises:
        RenderError: Chemicals grew beyond all bounds.
    """
    spec = reaction.spec
    before = reaction.cells.copy()
    after = before.copy()
    parameters = tuple(reaction.parameters[name] for name in spec.parameters)
    nothing = np.zeros((1, before.shape[2]))
    diffusions = tuple(reaction.parameters[name] if name else nothing for name in spec.spreading)
    taken, change = 0, 0.0
    while taken < spec.steps:
        fill_rim(before, spec.border)
        if reaction.tensors is None:
            spread(after, before, diffusions, spec.time_step)
        else:
            spread_along(after, before, reaction.tensors, diffusions, spec.time_step)
        react(after, before, parameters, spec.time_step)
        taken += 1
        if taken % _STEPS_PER_LOOK == 0 or taken == spec.steps:
            change = change_between(before, after, spec.time_step)
            if not np.isfinite(change) or np.abs(after).max() > _TOO_MUCH:
                raise RenderError(
                    f"the chemicals grew without end within {taken} steps", code="reaction_diverged"
                )
            report(
                taken / spec.steps,
                f"step {taken}",
                shown(spec, after, (spec.size[0], spec.size[1])) if taken < spec.steps else None,
            )
        before, after = after, before
        if taken % _STEPS_PER_LOOK == 0 and change < spec.still_below:
            break
    return before, taken, change


def change_between(before: Cells, after: Cells, time_step: float) -> float:
    """Return the fastest change of any cell per unit of time, NaN where a number is none."""
    with np.errstate(all="ignore"):
        return float(np.abs(after - before)[:, 1:-1, 1:-1].max() / time_step)


def outcome_of(
    reaction: Reaction, react: React, size: tuple[int, int], report: Progress
) -> Outcome:
    """Let a dish react and bring it to (width, height): the chemical shown, and all as layers."""
    spec = reaction.spec
    cells, taken, change = run(reaction, react, report)
    return Outcome(
        shown(spec, cells, size),
        {name: picture_of(cells[i], size) for i, name in enumerate(spec.layers)},
        told(spec, cells, taken, change),
    )


def shown(spec: ReactionSpec, cells: Cells, size: tuple[int, int]) -> Image:
    """Return the chemical that is asked for, as it is asked for, at (width, height)."""
    chemical = cells[spec.layers.index(spec.shown())]
    return picture_of(stretched(chemical) if spec.range == "stretched" else chemical, size)


def told(spec: DishSpec, cells: NDArray[Any], taken: int, change: float) -> dict[str, object]:
    """Return what the report says of a dish."""
    inside = cells[:, 1:-1, 1:-1]
    return {
        "steps": taken,
        "still": change < spec.still_below,
        "fastest_change": change,
        "chemicals": {
            name: {"least": float(c.min()), "greatest": float(c.max()), "mean": float(c.mean())}
            for name, c in zip(spec.layers, inside, strict=True)
        },
    }


def stretched(chemical: Cells) -> Cells:
    """Return numbers from 0 for the least to 1 for the greatest; all 0 where they are equal."""
    least, greatest = chemical[1:-1, 1:-1].min(), chemical[1:-1, 1:-1].max()
    return (chemical - least) / (greatest - least) if greatest > least else np.zeros_like(chemical)


def picture_of(chemical: Cells, size: tuple[int, int]) -> Image:
    """Return the dish without its rim as a picture of (width, height): one channel of data."""
    return Image(resample(held(chemical[1:-1, 1:-1])[..., np.newaxis], size), "data")


def warmed(spec: ReactionSpec, react: React) -> None:
    """Compile a reaction, and all that comes before and after it."""
    for described in (spec, spec.model_copy(update={"across": 0.5})):
        outcome_of(Reaction(described, {}), react, (8, 8), silent)
