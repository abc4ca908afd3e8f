"""The nearest patches of a whole picture: exactly, or quickly and nearly."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.synthesis._counter_hash import hashes
from worker.synthesis.by_example.exact import nearest_patches
from worker.synthesis.by_example.patch_match import NEVER, Field, Patches, evaluate, improve, lines
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from worker.stages import Report

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]

_PATCHES_AT_ONCE = 4096


def quick_field(
    target: Bytes, source: Bytes, usable: Mask, side: int, seed: int
) -> Iterator[Field]:
    """Yield a random field, then the same one after each pass of PatchMatch, without end.

    Args:
        target: Features, (height, width, channels).
        source: Features of the exemplar.
        usable: Which of its pixels a patch may hold; at least one patch has to.
        side: Of a patch, in pixels.
        seed: Of the random numbers.
    """
    allowed = whole_windows(usable, (side, side))
    corners = np.flatnonzero(allowed)
    shape = (target.shape[0] - side + 1, target.shape[1] - side + 1)
    chance = hashes(seed, 0, shape[0] * shape[1]) >> np.uint64(32)
    chosen = corners[((chance * np.uint64(len(corners))) >> np.uint64(32)).astype(np.int64)]
    rows, columns = np.divmod(chosen.astype(np.int32).reshape(shape), np.int32(allowed.shape[1]))
    patches = Patches(
        lines(target),
        lines(source),
        np.where(allowed, 0, NEVER).astype(np.int32),
        side,
        target.shape[2],
        1,
    )
    active = np.ones(shape, bool)
    field = Field.of(rows, columns)
    evaluate(patches, field, active)
    yield field
    iteration = 0
    while True:
        improve(
            patches,
            field,
            active,
            iteration=iteration,
            seed=seed,
            radius=max(allowed.shape),
            tries=2,
        )
        yield field
        iteration += 1


def exact_field(target: Bytes, source: Bytes, usable: Mask, side: int, report: Report) -> Field:
    """Return the nearest patch of the source for every patch of the target; see `quick_field`."""
    shape = (target.shape[0] - side + 1, target.shape[1] - side + 1)
    width = source.shape[1] - side + 1
    costs, corners = np.empty(shape, np.int32), np.empty(shape, np.int64)
    count = corners.size
    for start in range(0, count, _PATCHES_AT_ONCE):
        chosen = np.arange(start, min(start + _PATCHES_AT_ONCE, count))
        squares, places = nearest_patches(target, chosen, source, usable, side)
        costs.flat[chosen], corners.flat[chosen] = squares.astype(np.int32), places
        report(start / count, "comparing all patches")
    rows, columns = np.divmod(corners.astype(np.int32), np.int32(width))
    return Field(rows, columns, costs)
