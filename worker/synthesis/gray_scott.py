"""Reaction and diffusion of two chemicals (Gray and Scott, 1984; patterns by Pearson, 1993).

A step is a unit of time, a cell of the dish one of length. Diffusion is explicit with the
five-point Laplacian, the reaction takes u from the end of the step:

    u' = (u + diffusion_u Lap u + feed) / (1 + feed + v^2)
    v' = v + diffusion_v Lap v + u' v^2 - (feed + kill) v

This has the steady states of the differential equation and keeps the sum of u + v when feed and
kill are 0. Within the bounds of the parameters, diffusion_u <= 1/4 and 4 diffusion_v + feed + kill
<= 1, neither chemical becomes negative, and (1 + feed) u + v summed over the dish never exceeds the
larger of its start and 1 + feed per cell: every choice of parameters stays finite, which an
explicit reaction does not promise.

It starts at rest, u = 1 and v = 0, but for square drops with u = 1/2 and v = 1/4, disturbed by 1 %,
or where a mask says.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from api_schemas.dishes import mapped
from api_schemas.textures.gray_scott import GrayScottSpec
from worker.images.image import Image
from worker.outcome import Outcome
from worker.stages import silent
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._dish import channels, parameter_rows
from worker.synthesis._gray_scott_steps import BORDERS, STEPS_AT_ONCE, advance, fill_changes
from worker.synthesis._reaction import told
from worker.synthesis._resample import resample

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.preview import Progress
    from worker.synthesis._gray_scott_steps import Rates

    Field = NDArray[np.float32]

_DROP_SIDE = 12
_PASSES_PER_LOOK = 8
_ROUNDED_OFF = 1e-12
"""A discriminant no further below 0 than this is 0: rounding took it there."""


def synthesize(
    spec: GrayScottSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Let the dish react and bring it to (width, height): one channel of data."""
    cells, taken, change = run(spec, *initial_dish(spec, inputs), rates_of(spec, inputs), report)
    layers = {
        name: Image(resample(cells[i, 1:-1, 1:-1, np.newaxis], size), spec.meaning)
        for i, name in enumerate(spec.layers)
    }
    facts = told(spec, cells, taken, change)
    if isinstance(spec.feed, float) and isinstance(spec.kill, float):
        facts["steady_states"] = [{"u": u, "v": v} for u, v in steady_states(spec.feed, spec.kill)]
    return Outcome(layers[spec.chemical], layers, facts)


def initial_dish(
    spec: GrayScottSpec, inputs: Mapping[str, Image] | None = None
) -> tuple[Field, Field]:
    """Return u and v, (height, width) each, before the first step."""
    inputs = inputs or {}
    width, height = spec.size
    u, v = np.ones((height, width), np.float32), np.zeros((height, width), np.float32)
    if "start" in inputs:
        # What is outside of 0..1 no chemical is
        given = np.clip(channels(spec, inputs["start"]), 0, 1).astype(np.float32)
        return given[0], given[1] if len(given) > 1 else v
    if "mask" in inputs:
        share = np.clip(channels(spec, inputs["mask"])[0], 0, 1).astype(np.float32)
        u, v = 1 - share / 2, share / 4
    else:
        _add_drops(u, v, spec)
    disturbed = v > 0
    for use, chemical in ((2, u), (3, v)):
        noise = 0.99 + 0.02 * uniforms(spec.seed, use, width * height).reshape(height, width)
        chemical[disturbed] *= noise[disturbed].astype(np.float32)
    return u, v


def rates_of(spec: GrayScottSpec, inputs: Mapping[str, Image]) -> Rates:
    """Return feed, feed + kill and both diffusions, as numbers or, if one is a map, as rows."""
    rows = parameter_rows(spec, inputs)
    feed, across, down = (rows[name] for name in ("feed", "diffusion_u", "diffusion_v"))
    rates = (feed, feed + rows["kill"], across, down)
    if any(mapped(spec, name) for name in spec.parameters):
        return tuple(np.ascontiguousarray(rate, np.float32) for rate in rates)
    return tuple(np.float32(rate[0, 1]) for rate in rates)


def steady_states(feed: float, kill: float) -> list[tuple[float, float]]:
    """Return u and v that stay where they are the same everywhere, the least v first."""
    loss = feed + kill
    under_root = 1 - 4 * loss * loss / feed if feed > 0 else -1.0
    if under_root < -_ROUNDED_OFF:
        return [(1.0, 0.0)]
    root = sqrt(max(under_root, 0.0))
    larger = (1 + root) / 2
    states = [(1.0, 0.0), (larger, loss / larger)]
    if root:
        # The product of both u is loss^2 / feed: 1 - root would lose its digits
        states.append((loss * loss / feed / larger, feed * larger / loss))
    return states


def run(
    spec: GrayScottSpec, u: Field, v: Field, rates: Rates, report: Progress = silent
) -> tuple[Field, int, float]:
    """Take the steps from u and v, (height, width) each.

    The dish so far is shown at each look but the last one.

    Returns:
        Both with a rim, (2, height + 2, width + 2); how many steps were taken; how fast the fastest
        cell changed between the last two looks.
    """
    before = np.pad(np.stack([u, v], axis=1), ((1, 1), (0, 0), (1, 1)), mode="wrap")
    border = BORDERS[spec.border]
    if spec.border == "fixed":
        for chemical, rest in enumerate((1, 0)):
            before[[0, -1], chemical] = before[:, chemical, [0, -1]] = rest
    elif spec.border == "no_flux":
        before[..., 0], before[..., -1] = before[..., 1], before[..., -2]
    after, seen = before.copy(), before.copy()
    changes = np.empty(len(before) - 2, np.float32)
    taken, change = 0, 0.0
    while taken < spec.steps:
        np.copyto(seen, before)
        start = taken
        for _ in range(_PASSES_PER_LOOK):
            steps = min(STEPS_AT_ONCE, spec.steps - taken)
            if steps:
                advance(after, before, rates, steps, border)
                before, after, taken = after, before, taken + steps
        so_far = before[1:-1, spec.layers.index(spec.chemical), 1:-1, np.newaxis]
        report(
            taken / spec.steps,
            f"step {taken}",
            Image(so_far.copy(), spec.meaning) if taken < spec.steps else None,
        )
        fill_changes(changes, seen, before)
        change = float(changes.max()) / (taken - start)
        if change < spec.still_below:
            break
    return before.transpose(1, 0, 2), taken, change


def react(u: Field, v: Field, spec: GrayScottSpec) -> tuple[Field, Field]:
    """Return u and v, (height, width) each, `spec.steps` steps later, without maps."""
    cells, _, _ = run(spec, u, v, rates_of(spec, {}))
    return cells[0, 1:-1, 1:-1], cells[1, 1:-1, 1:-1]


def warm() -> None:
    """Compile the kernels, for numbers and for maps."""
    spec = GrayScottSpec(technique="gray_scott", size=[16, 16], steps=1)
    numbers = rates_of(spec, {})
    rows = tuple(np.full((1, 18), rate, np.float32) for rate in numbers)
    for rates in (numbers, rows):
        run(spec, *initial_dish(spec), rates)
    synthesize(spec, (8, 8), {}, silent)


def _add_drops(u: Field, v: Field, spec: GrayScottSpec) -> None:
    width, height = spec.size
    lefts = (uniforms(spec.seed, 0, spec.drops) * width).astype(np.int64)
    tops = (uniforms(spec.seed, 1, spec.drops) * height).astype(np.int64)
    across = np.arange(min(_DROP_SIDE, width))
    down = np.arange(min(_DROP_SIDE, height))[:, np.newaxis]
    for left, top in zip(lefts, tops, strict=True):
        u[(top + down) % height, (left + across) % width] = 0.5
        v[(top + down) % height, (left + across) % width] = 0.25
