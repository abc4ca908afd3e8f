"""An activator that feeds its own inhibitor.

Gierer and Meinhardt, 1972; Meinhardt, 1982; Turk, 1991.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from api_schemas.textures.meinhardt_spots import MeinhardtSpotsSpec
from worker.numba_kernel import kernel
from worker.synthesis._dish import at
from worker.synthesis._reaction import Reaction, outcome_of, warmed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from worker.images.image import Image
    from worker.outcome import Outcome
    from worker.preview import Progress
    from worker.synthesis._dish import Cells, Rows

_LEAST = 1e-9
"""Less of an inhibitor counts as this much: where there is none, nothing becomes infinite."""


def synthesize(
    spec: MeinhardtSpotsSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Let the dish react and bring it to (width, height)."""
    reaction = Reaction(spec, inputs)
    reaction.vary("beta", spec.irregularity)
    return outcome_of(reaction, _react, size, report)


def warm() -> None:
    """Compile the kernels."""
    warmed(MeinhardtSpotsSpec(technique="meinhardt_spots", size=[16, 16], steps=1), _react)


@kernel
def _react(after: Cells, before: Cells, parameters: tuple[Rows, ...], time_step: float) -> None:
    _, height, width = before.shape
    for row in range(1, height - 1):
        a, b = before[0, row], before[1, row]
        speed = at(parameters[0], row)
        source = at(parameters[1], row)
        decay_a = at(parameters[2], row)
        decay_b = at(parameters[3], row)
        base = at(parameters[4], row)
        for x in range(1, width - 1):
            pace = time_step * speed[x]
            made = 0.01 * a[x] * a[x] * source[x]
            change_a = made / max(b[x], _LEAST) - decay_a[x] * a[x] + base[x]
            change_b = made - decay_b[x] * b[x] + base[x]
            after[0, row, x] = max(after[0, row, x] + pace * change_a, 0.0)
            after[1, row, x] = max(after[1, row, x] + pace * change_b, 0.0)
