"""Diffusion with a direction at every point (Kass and Witkin, 1991), by explicit steps in float64.

Flows are between neighbours, so that what leaves a cell enters others and nothing is lost. With one
direction for all the step is their mask of 3 x 3 cells: the centre loses 2 (D11 + D22), neighbours
along u gain D11, along v D22, those on diagonals +-D12 / 2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.anisotropic_diffusion import AnisotropicDiffusionSpec
from api_schemas.textures.constant import ConstantSpec
from worker.images.image import Image
from worker.numba_kernel import kernel
from worker.outcome import Outcome
from worker.stages import silent
from worker.synthesis._directions import angles_of, inflow_at, tensors_along
from worker.synthesis._dish import at, channels, fill_rim, parameter_rows
from worker.synthesis._pointwise import held
from worker.synthesis._resample import resample

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from worker.preview import Progress
    from worker.synthesis._dish import Cells, Row, Rows

_STEPS_PER_LOOK = 64


def synthesize(
    spec: AnisotropicDiffusionSpec,
    size: tuple[int, int],
    inputs: Mapping[str, Image],
    report: Progress,
) -> Outcome:
    """Let `inputs["input"]` spread and bring it to (width, height)."""
    image = inputs["input"]
    rows = parameter_rows(spec, inputs)

    def told(share: float, step: str, so_far: Cells | None) -> None:
        report(share, step, None if so_far is None else Image(_pixels(so_far), image.meaning))

    cells, taken, change = run(
        spec, channels(spec, image), tensors_of(spec, rows, inputs.get("guide")), rows, told
    )
    facts = {"steps": taken, "still": change < spec.still_below, "fastest_change": change}
    return Outcome(Image(resample(_pixels(cells), size), image.meaning), report=facts)


def _pixels(cells: Cells) -> NDArray[np.float32]:
    """Return (channels, height, width) cells as a picture has them."""
    return np.ascontiguousarray(held(cells).transpose(1, 2, 0))


def tensors_of(
    spec: AnisotropicDiffusionSpec, rows: Mapping[str, Rows], guide: Image | None = None
) -> Cells:
    """Return the tensor of every cell with its rim, as `_directions` makes them."""
    angle = angles_of(spec, rows["direction"], guide, spec.guide_radius)
    return tensors_along(angle, rows["along"][:, 1:-1], rows["across"][:, 1:-1], spec.border)


def run(
    spec: AnisotropicDiffusionSpec,
    start: Cells,
    tensors: Cells,
    rows: Mapping[str, Rows],
    report: Callable[[float, str, Cells | None], None] = silent,
) -> tuple[Cells, int, float]:
    """Return (channels, height, width) cells after the steps, how many those were, and the change.

    The change is that of the fastest cell at the last look, per unit of time. What a fixed rim
    holds is 0. `report` is also given the cells so far, at each look but the last one.
    """
    before = np.pad(start, ((0, 0), (1, 1), (1, 1)))
    after = before.copy()
    taken, change = 0, 0.0
    while taken < spec.steps:
        fill_rim(before, spec.border)
        _step(after, before, tensors, rows["dissipation"], rows["inflow"], spec.time_step)
        before, after, taken = after, before, taken + 1
        if taken % _STEPS_PER_LOOK == 0 or taken == spec.steps:
            so_far = before[:, 1:-1, 1:-1] if taken < spec.steps else None
            report(taken / spec.steps, f"step {taken}", so_far)
            change = float(np.abs(after - before)[:, 1:-1, 1:-1].max() / spec.time_step)
            if change < spec.still_below:
                break
    return before[:, 1:-1, 1:-1], taken, change


def warm() -> None:
    """Compile the kernels."""
    spec = AnisotropicDiffusionSpec(
        technique="anisotropic_diffusion",
        input=ConstantSpec(technique="constant", value=0.0),
        size=[16, 16],
        steps=1,
    )
    synthesize(spec, (8, 8), {"input": Image(np.zeros((16, 16, 1), np.float32), "data")}, silent)


@kernel
def _step(
    after: Cells,
    before: Cells,
    tensors: Cells,
    dissipation: Rows,
    inflow: Rows,
    time_step: float,
) -> None:
    channels, height, _ = before.shape
    for channel in range(channels):
        for row in range(1, height - 1):
            _step_row(
                after[channel, row],
                before[channel, row - 1 : row + 2],
                tensors[:, row - 1 : row + 2],
                at(dissipation, row),
                at(inflow, row),
                time_step,
            )


@kernel
def _step_row(after: Row, c: Cells, tensors: Cells, loss: Row, gain: Row, time_step: float) -> None:
    for x in range(1, len(after) - 1):
        here = c[1, x]
        gained = inflow_at(c, tensors, x)
        after[x] = here + time_step * (gained - loss[x] * here + gain[x])
