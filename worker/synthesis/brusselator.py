"""Chemicals that oscillate or stand in stripes.

Prigogine and Lefever, 1968.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from api_schemas.textures.brusselator import BrusselatorSpec
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
    spec: BrusselatorSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Let the dish react and bring it to (width, height)."""
    return outcome_of(Reaction(spec, inputs), _react, size, report)


def warm() -> None:
    """Compile the kernels."""
    warmed(BrusselatorSpec(technique="brusselator", size=[16, 16], steps=1), _react)


@kernel
def _react(after: Cells, before: Cells, parameters: tuple[Rows, ...], time_step: float) -> None:
    _, height, width = before.shape
    for row in range(1, height - 1):
        u, v = before[0, row], before[1, row]
        speed = at(parameters[0], row)
        inflow = at(parameters[1], row)
        turnover = at(parameters[2], row)
        for x in range(1, width - 1):
            pace = time_step * speed[x]
            made, turned = u[x] * u[x] * v[x], turnover[x] * u[x]
            after[0, row, x] += pace * (inflow[x] - turned - u[x] + made)
            after[1, row, x] += pace * (turned - made)
