"""Chemicals as Turing imagined them.

Turing, 1952; Turk, 1991.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from api_schemas.textures.turing import TuringSpec
from worker.numba_kernel import kernel
from worker.synthesis._dish import at
from worker.synthesis._reaction import Reaction, outcome_of, warmed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from worker.images.image import Image
    from worker.outcome import Outcome
    from worker.preview import Progress
    from worker.synthesis._dish import Cells, Rows


def synthesize(
    spec: TuringSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Let the dish react and bring it to (width, height)."""
    reaction = Reaction(spec, inputs)
    reaction.vary("beta", spec.irregularity)
    return outcome_of(reaction, _react, size, report)


def warm() -> None:
    """Compile the kernels."""
    warmed(TuringSpec(technique="turing", size=[16, 16], steps=1), _react)


@kernel
def _react(after: Cells, before: Cells, parameters: tuple[Rows, ...], time_step: float) -> None:
    _, height, width = before.shape
    for row in range(1, height - 1):
        a, b = before[0, row], before[1, row]
        speed = at(parameters[0], row)
        taken = at(parameters[1], row)
        for x in range(1, width - 1):
            pace = time_step * speed[x]
            met = a[x] * b[x]
            after[0, row, x] += pace * (16.0 - met)
            change = pace * (met - b[x] - taken[x])
            after[1, row, x] = max(after[1, row, x] + change, 0.0)
