"""Two activators that keep each other at arm's length.

Meinhardt, 1982; Turk, 1991.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from api_schemas.textures.meinhardt_stripes import MeinhardtStripesSpec
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
    spec: MeinhardtStripesSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Let the dish react and bring it to (width, height)."""
    reaction = Reaction(spec, inputs)
    reaction.vary("beta", spec.irregularity)
    return outcome_of(reaction, _react, size, report)


def warm() -> None:
    """Compile the kernels."""
    warmed(MeinhardtStripesSpec(technique="meinhardt_stripes", size=[16, 16], steps=1), _react)


@kernel
def _react(after: Cells, before: Cells, parameters: tuple[Rows, ...], time_step: float) -> None:
    _, height, width = before.shape
    for row in range(1, height - 1):
        a, b, c, d, e = (
            before[0, row],
            before[1, row],
            before[2, row],
            before[3, row],
            before[4, row],
        )
        source = at(parameters[0], row)
        decay = at(parameters[1], row)
        decay_c = at(parameters[2], row)
        follow = at(parameters[3], row)
        for x in range(1, width - 1):
            inhibitor = max(c[x], _LEAST)
            made_a = 0.01 * a[x] * a[x] * e[x] * source[x]
            made_b = 0.01 * b[x] * b[x] * d[x]
            after[0, row, x] += time_step * (made_a / inhibitor - decay[x] * a[x])
            after[1, row, x] += time_step * (made_b / inhibitor - decay[x] * b[x])
            after[2, row, x] += time_step * (made_a + made_b - decay_c[x] * c[x])
            after[3, row, x] += time_step * (a[x] - d[x]) * follow[x]
            after[4, row, x] += time_step * (b[x] - e[x]) * follow[x]
