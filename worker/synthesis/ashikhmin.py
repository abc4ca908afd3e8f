"""Texture grown pixel by pixel out of pieces of an exemplar (Ashikhmin, 2001).

A pixel's candidates are its neighbours' source pixels, shifted to where it lies from them: it
likes to go on where a neighbour is. The one whose surroundings fit best is taken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from api_schemas.textures.ashikhmin import AshikhminSpec
from api_schemas.textures.perlin import PerlinSpec
from worker.images.image import Image
from worker.numba_kernel import kernel
from worker.stages import silent
from worker.synthesis._counter_hash import hashes
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.features import weighed
from worker.synthesis.by_example.hashing import below, scrambled
from worker.synthesis.by_example.result import finished
from worker.synthesis.by_example.windows import middles
from worker.synthesis.by_example.wishes import Wishes

if TYPE_CHECKING:
    from collections.abc import Mapping

    from worker.outcome import Outcome
    from worker.stages import Report
    from worker.synthesis.by_example.arrays import Bytes, Integers, Mask


_FIRST_TRIES = 32


class Pair(NamedTuple):
    """What is compared: features, (height, width, channels), of exemplar and result.

    Of the guides nothing is ever changed; where there are none they have no channels.
    """

    source: Bytes
    target: Bytes
    source_guide: Bytes
    target_guide: Bytes


def synthesize(
    spec: AshikhminSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Grow `spec.size` pixels and bring them to (width, height).

    An exemplar too small for the neighbourhood is compared with a smaller one.

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    wishes = Wishes.of(spec, exemplar, inputs)
    height, width = wishes.fixed.shape
    source = weighed(exemplar.features, wishes.share)
    target = np.zeros((height, width, source.shape[2]), np.uint8)
    if wishes.keep is not None:
        target = weighed(exemplar.matching(wishes.keep), wishes.share)
    nothing = np.zeros((1, 1, 0), np.uint8)
    pair = Pair(source, target, *(wishes.guides or (nothing, nothing)))
    across, above, allowed = _fitting(exemplar.usable, spec.neighbourhood)
    choices = np.flatnonzero(allowed).astype(np.int32)
    place = np.full((height, width), -1, np.int32)
    _scatter(place, *pair, wishes.fixed, choices, hashes(spec.seed, 0, 1)[0])
    for turn in range(spec.passes):
        report(turn / spec.passes, f"pass {turn + 1} of {spec.passes}")
        key = hashes(spec.seed, turn + 1, 1)[0]
        forward, whole = turn % 2 == 0, turn > 0
        _scan(place, *pair, wishes.fixed, allowed, choices, across, above, forward, whole, key)
    rows, columns = np.divmod(place, np.int32(source.shape[1]))
    found = np.stack([rows, columns], axis=-1)
    found[wishes.fixed] = -1
    return finished(found, exemplar, inputs, size, wishes.keep)


def warm() -> None:
    """Compile the kernels."""
    picture = Image(np.linspace(0, 1, 147, dtype=np.float32).reshape(7, 7, 3), "colour")
    spec = AshikhminSpec(
        technique="ashikhmin", exemplar=PerlinSpec(technique="perlin"), size=[9, 9], passes=2
    )
    synthesize(spec, (9, 9), {"exemplar": picture}, silent)


def _fitting(usable: Mask, neighbourhood: list[int]) -> tuple[int, int, Mask]:
    """Return the columns and rows of the largest neighbourhood that fits somewhere, and where."""
    across, above = neighbourhood
    while True:
        allowed = middles(usable, (2 * above + 1, 2 * across + 1))
        if allowed.any():
            return across, above, allowed
        across, above = max(0, across - 1), max(0, above - 1)


@kernel
def _scatter(
    place: Integers,
    source: Bytes,
    target: Bytes,
    source_guide: Bytes,
    target_guide: Bytes,
    fixed: Mask,
    choices: Integers,
    key: np.uint64,
) -> None:
    """Begin with random source pixels; with a guide, with the one most like it of some."""
    height, width = place.shape
    across = source.shape[1]
    guided = source_guide.shape[2] > 0
    for y in range(height):
        for x in range(width):
            if fixed[y, x]:
                continue
            nearest = np.int64(2**62)
            for turn in range(_FIRST_TRIES if guided else 1):
                bits = scrambled(key, (y * width + x) * _FIRST_TRIES + turn)
                chosen = choices[below(bits, len(choices))]
                v, u = chosen // across, chosen % across
                cost = _apart(source_guide, v, u, target_guide, y, x) if guided else np.int64(0)
                if cost < nearest:
                    nearest = cost
                    place[y, x] = chosen
            v, u = place[y, x] // across, place[y, x] % across
            target[y, x] = source[v, u]


@kernel
def _scan(
    place: Integers,
    source: Bytes,
    target: Bytes,
    source_guide: Bytes,
    target_guide: Bytes,
    fixed: Mask,
    allowed: Mask,
    choices: Integers,
    across: int,
    above: int,
    forward: bool,
    whole: bool,
    key: np.uint64,
) -> None:
    """Choose every pixel anew, one after the other; `whole` compares the square all around."""
    height, width = place.shape
    lower, wide = allowed.shape
    guided = source_guide.shape[2] > 0
    step = 1 if forward else -1
    candidates = np.empty((2 * above + 1) * (2 * across + 1), np.int32)
    for row in range(height):
        y = row if forward else height - 1 - row
        for column in range(width):
            x = column if forward else width - 1 - column
            if fixed[y, x]:
                continue
            count = 0
            for down in range(-above, (above if whole else 0) + 1):
                for right in range(-across, across + 1):
                    if down == 0 and (right == 0 or (right > 0 and not whole)):
                        continue
                    near_y = (y + step * down) % height
                    near_x = (x + step * right) % width
                    found = place[near_y, near_x]
                    if found < 0:
                        continue
                    v = found // wide - step * down
                    u = found % wide - step * right
                    if not (0 <= v < lower and 0 <= u < wide) or not allowed[v, u]:
                        bits = scrambled(key, ((y * width + x) * 32 + down) * 32 + right)
                        chosen = choices[below(bits, len(choices))]
                        v, u = chosen // wide, chosen % wide
                    candidate = v * wide + u
                    known = 0
                    while known < count and candidates[known] != candidate:
                        known += 1
                    if known == count:
                        candidates[count] = candidate
                        count += 1
            if count == 0:
                continue
            best = candidates[0]
            nearest = np.int64(2**62)
            for k in range(count):
                if count == 1:
                    break
                v, u = candidates[k] // wide, candidates[k] % wide
                cost = np.int64(0)
                for down in range(-above, above + 1):
                    for right in range(-across, across + 1):
                        if down == 0 and right == 0 and not guided:
                            continue
                        near_y = (y + step * down) % height
                        near_x = (x + step * right) % width
                        far_v, far_u = v + step * down, u + step * right
                        done = down < 0 or (down == 0 and right < 0)
                        if done or (whole and not (down == 0 and right == 0)):
                            cost += _apart(source, far_v, far_u, target, near_y, near_x)
                        if guided and not done:
                            cost += _apart(source_guide, far_v, far_u, target_guide, near_y, near_x)
                    if cost >= nearest:
                        break
                if cost < nearest:
                    nearest, best = cost, candidates[k]
            place[y, x] = best
            v, u = best // wide, best % wide
            for channel in range(source.shape[2]):
                target[y, x, channel] = source[v, u, channel]


@kernel
def _apart(ours: Bytes, v: int, u: int, theirs: Bytes, y: int, x: int) -> np.int64:
    """Return the squared difference of two pixels."""
    total = np.int64(0)
    for channel in range(ours.shape[2]):
        step = np.int64(ours[v, u, channel]) - np.int64(theirs[y, x, channel])
        total += step * step
    return total
