"""Reaction and diffusion of two chemicals (Gray and Scott, 1984; patterns by Pearson, 1993).

A dish of grid cells that joins its opposite edges; a step is a unit of time, a cell one of length.
Diffusion is explicit with the five-point Laplacian, the reaction takes u from the end of the step:

    u' = (u + diffusion_u Lap u + feed) / (1 + feed + v^2)
    v' = v + diffusion_v Lap v + u' v^2 - (feed + kill) v

This has the steady states of the differential equation and keeps the sum of u + v when feed and
kill are 0. Within the bounds of the parameters, diffusion_u <= 1/4 and 4 diffusion_v + feed + kill
<= 1, neither chemical becomes negative, and (1 + feed) u + v summed over the dish never exceeds the
larger of its start and 1 + feed per cell: every choice of parameters stays finite, which an
explicit reaction does not promise.

It starts at rest, u = 1 and v = 0, but for square drops with u = 1/2 and v = 1/4, disturbed by 1 %.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.gray_scott import GrayScottSpec
from worker.images.image import Image
from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.stages import silent
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._resample import resample

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    Field = NDArray[np.float32]

    from worker.stages import Report

_DROP_SIDE = 12
_BLOCK_ROWS = 16


def synthesize(
    spec: GrayScottSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Let the dish react and bring it to (width, height): one channel of data."""
    u, v = react(*initial_dish(spec), spec)
    pixels = (u if spec.chemical == "u" else v)[..., np.newaxis]
    return Image(resample(pixels, size), spec.meaning)


def initial_dish(spec: GrayScottSpec) -> tuple[Field, Field]:
    """Return u and v, (height, width) each, before the first step."""
    width, height = spec.size
    u, v = np.ones((height, width), np.float32), np.zeros((height, width), np.float32)
    lefts = (uniforms(spec.seed, 0, spec.drops) * width).astype(np.int64)
    tops = (uniforms(spec.seed, 1, spec.drops) * height).astype(np.int64)
    across = np.arange(min(_DROP_SIDE, width))
    down = np.arange(min(_DROP_SIDE, height))[:, np.newaxis]
    for left, top in zip(lefts, tops, strict=True):
        u[(top + down) % height, (left + across) % width] = 0.5
        v[(top + down) % height, (left + across) % width] = 0.25
    disturbed = v > 0
    for use, chemical in ((2, u), (3, v)):
        noise = 0.99 + 0.02 * uniforms(spec.seed, use, width * height).reshape(height, width)
        chemical[disturbed] *= noise[disturbed].astype(np.float32)
    return u, v


def react(u: Field, v: Field, spec: GrayScottSpec) -> tuple[Field, Field]:
    """Return u and v, (height, width) each, `spec.steps` steps later."""
    us, vs = np.stack([u, u]), np.stack([v, v])
    rates = np.array(
        [spec.feed, spec.feed + spec.kill, spec.diffusion_u, spec.diffusion_v], np.float32
    )
    _run(us, vs, spec.steps, rates)
    return us[spec.steps % 2], vs[spec.steps % 2]


def warm() -> None:
    """Compile the kernels."""
    spec = GrayScottSpec(technique="gray_scott", size=[16, 16], steps=1)
    synthesize(spec, (8, 8), {}, silent)


@parallel_kernel
def _run(us: Field, vs: Field, steps: int, rates: Field) -> None:
    """Step to and fro between the two halves of (2, height, width) fields."""
    height = us.shape[1]
    blocks = (height + _BLOCK_ROWS - 1) // _BLOCK_ROWS
    for step in range(steps):
        u, v, u_next, v_next = us[step % 2], vs[step % 2], us[1 - step % 2], vs[1 - step % 2]
        for block in prange(blocks):
            for row in range(block * _BLOCK_ROWS, min((block + 1) * _BLOCK_ROWS, height)):
                above, below = (row - 1) % height, (row + 1) % height
                _step_u(u_next[row], u[above], u[row], u[below], v[row], rates[0], rates[2])
                _step_v(v_next[row], v[above], v[row], v[below], u_next[row], rates[1], rates[3])


@kernel
def _step_u(
    after: Field, above: Field, u: Field, below: Field, v: Field, feed: float, diffusion: float
) -> None:
    one, four = np.float32(1), np.float32(4)
    width = len(u)
    for x in range(1, width - 1):
        spread = diffusion * (above[x] + below[x] + u[x - 1] + u[x + 1] - four * u[x])
        after[x] = (u[x] + spread + feed) / (one + feed + v[x] * v[x])
    for x in (0, width - 1):
        right = u[(x + 1) % width]
        spread = diffusion * (above[x] + below[x] + u[x - 1] + right - four * u[x])
        after[x] = (u[x] + spread + feed) / (one + feed + v[x] * v[x])


@kernel
def _step_v(
    after: Field, above: Field, v: Field, below: Field, u: Field, loss: float, diffusion: float
) -> None:
    four, zero, nothing = np.float32(4), np.float32(0), np.float32(1e-15)
    width = len(v)
    # Traces are cleared away: the numbers below float32's normal ones are slow to compute with
    for x in range(1, width - 1):
        spread = diffusion * (above[x] + below[x] + v[x - 1] + v[x + 1] - four * v[x])
        value = v[x] + spread + u[x] * (v[x] * v[x]) - loss * v[x]
        after[x] = value if value > nothing else zero
    for x in (0, width - 1):
        right = v[(x + 1) % width]
        spread = diffusion * (above[x] + below[x] + v[x - 1] + right - four * v[x])
        value = v[x] + spread + u[x] * (v[x] * v[x]) - loss * v[x]
        after[x] = value if value > nothing else zero
