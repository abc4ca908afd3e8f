"""What texture optimisation is asked for, and the same from coarse to fine."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.synthesis.by_example.pyramid import halved
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]

PATCH_SIDE = 9
"""Of patches in pixels on every level, where source and target are large enough."""
_COARSEST_SIDE = 24
_LEAST_PATCHES = 16


@dataclass(frozen=True, slots=True)
class Task:
    """What is to be made of what.

    Attributes:
        source: Features of the exemplar, (height, width, channels).
        usable: Which of its pixels may be copied.
        size: Height and width of the target.
        tileable: Whether the target goes on around its edges.
        seed: Of everything random.
        guides: Further channels of source and target that have to agree, or None.
        fixed: Which target pixels stay, (height, width), or None for none.
        target: Their features, (height, width, channels), where any are fixed.
        variety: How strongly patches are kept from being used too often; 1 is ordinary.
        start: A coordinate map, (height, width, 2) of any size, that is like the one wanted.
        longest_copy: How much of the exemplar's height and width may be copied in one line, 0..1;
            None for any length.
        smallest: How much of its height and width the smallest exemplar has that it holds.
    """

    source: Bytes
    usable: Mask
    size: tuple[int, int]
    tileable: bool
    seed: int
    guides: tuple[Bytes, Bytes] | None = None
    fixed: Mask | None = None
    target: Bytes | None = None
    variety: float = 1.0
    start: Integers | None = None
    longest_copy: float | None = None
    smallest: tuple[float, float] = (1.0, 1.0)

    def keeping(self, target: Bytes, fixed: Mask) -> Task:
        """Return the same task with some finished pixels."""
        return replace(self, target=target, fixed=fixed)


class Level(NamedTuple):
    """A task at one size.

    Attributes:
        source: Features of the exemplar, then its guides.
        usable: Which of its pixels may be copied.
        target: Features of the target, as far as they are fixed, then its guides.
        fixed: Which of its pixels stay.
        depth: 0 is the coarsest level.
    """

    source: Bytes
    usable: Mask
    target: Bytes
    fixed: Mask
    depth: int


def levels(task: Task) -> list[Level]:
    """Return a task at all sizes, from coarse to fine.

    Halving ends before a side falls below 24 pixels, or too few patches could be copied.
    """
    source, usable, target, fixed = _joined(task)
    voted = task.source.shape[2]
    found = []
    while True:
        found.append((np.ascontiguousarray(source), usable, target, fixed))
        source, usable = halved(source, usable)
        if task.guides is None and not fixed.any():
            # Nothing is known of the target but its size, and it may be large
            height, width = (max(1, length // 2) for length in fixed.shape)
            target, fixed = target[:height, :width], fixed[:height, :width]
        else:
            guides, _ = halved(target[..., voted:], np.ones(fixed.shape, bool), wraps=task.tileable)
            colours, fixed = halved(target[..., :voted], fixed, wraps=task.tileable)
            target = np.concatenate([colours, guides], axis=-1)
        small = min(*usable.shape, *fixed.shape) < _COARSEST_SIDE
        if small or not _enough(usable) or fixed.all():
            return [Level(*parts, depth) for depth, parts in enumerate(reversed(found))]


def _joined(task: Task) -> tuple[Bytes, Mask, Bytes, Mask]:
    """Return source, what is usable of it, target and what is fixed of it, guides appended."""
    height, width = task.size
    fixed = np.zeros((height, width), bool) if task.fixed is None else task.fixed
    empty = np.zeros((height, width, task.source.shape[2]), np.uint8)
    target = empty if task.target is None else task.target
    if task.guides is None:
        return task.source, task.usable, target, fixed
    ours, theirs = task.guides
    return (
        np.concatenate([task.source, ours], axis=-1),
        task.usable,
        np.concatenate([target, theirs], axis=-1),
        fixed,
    )


def _enough(usable: Mask) -> bool:
    return int(whole_windows(usable, (PATCH_SIDE, PATCH_SIDE)).sum()) >= _LEAST_PATCHES
