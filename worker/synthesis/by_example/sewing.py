"""What lies somewhere and a square laid over it, sewn together where it is seen least.

How much is seen of the seam between two neighbours is how much the two squares differ at both of
them, divided by how much both squares change there anyway: along an edge of what they show a seam
is hidden (Kwatra et al., 2003, eq. 6). Where that breaks the triangle inequality, an old seam is
taken to be no worse than the two new ones in its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worker.synthesis.by_example.flow_cut import Pairs, least_cut

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.views import Views

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]

_MOST_TOGETHER = 2**29
"""What all costs of a square add up to at most; flows of twice as much fit 31 bits."""
_MOST_APART = 2 * 255
_HARDLY_CHANGES = 8
"""Changes at both pixels of both squares, in steps of a channel: less hides no seam."""

NEIGHBOURS = (((0, 1), np.s_[:, :-1], np.s_[:, 1:]), ((1, 0), np.s_[:-1], np.s_[1:]))
"""The step from a pixel to the next one; which pixels are the first ones, and which the next."""


@dataclass(frozen=True, slots=True)
class Seams:
    """How much is seen of seams between squares of an exemplar.

    Attributes:
        views: Of the exemplar.
        scale: How many times one what costs are multiples of.
        changes: How much colours change to the right and downwards at each pixel of the views,
            (2, pixels): half the difference of the pixels on both sides, of all channels together.
    """

    views: Views
    scale: int
    changes: Integers

    @classmethod
    def of(cls, views: Views, side: int) -> Seams:
        """Take the views of which squares of `side` pixels are laid."""
        changes = []
        for view in views.names:
            around = np.pad(views.planes(view), ((0, 0), (1, 1), (1, 1)), mode="edge")
            across = np.abs(around[:, 1:-1, 2:] - around[:, 1:-1, :-2]).sum(axis=0)
            down = np.abs(around[:, 2:, 1:-1] - around[:, :-2, 1:-1]).sum(axis=0)
            changes.append(np.stack([across.ravel(), down.ravel()]).astype(np.int64) // 2)
        pairs = 2 * (side + 1) * (side + 2)
        scale = _MOST_TOGETHER * _HARDLY_CHANGES // (pairs * _MOST_APART)
        return cls(views, scale, np.concatenate(changes, axis=1))

    def seen(self, first: Integers, second: Integers, step: tuple[int, int]) -> Integers:
        """Return how much is seen of the seam between neighbours, each from a square of its own."""
        move = np.array([0, *step])
        features = self.views.features
        apart, change = 0, _HARDLY_CHANGES * features.shape[1]
        for one, other in ((first, second - move), (first + move, second)):
            ours, theirs = self.views.pixels(one), self.views.pixels(other)
            apart = apart + np.abs(features[ours].astype(np.int64) - features[theirs]).sum(axis=-1)
            change = change + self.changes[step[0], ours] + self.changes[step[0], theirs]
        return np.asarray(apart * self.scale // change)

    def all_seen(self, spots: Integers, known: Mask) -> Integers:
        """Return how much is seen of each seam among spots, of which only known ones count."""
        found = []
        for step, first, second in NEIGHBOURS:
            both = known[first] & known[second]
            found.append(self.seen(spots[first][both], spots[second][both], step))
        return np.concatenate(found)


def sewn(seams: Seams, old: Integers, new: Integers, free: Mask) -> Integers:
    """Return spots of which each is the old or the new one, so that seams are seen least.

    Args:
        seams: What they cost.
        old: Spots that are there already, (rows, columns, 3), the view -1 where nothing is known.
        new: Spots of one square, that are taken where nothing is known.
        free: Where new ones may be taken, (rows, columns); all others stay, known or not.
    """
    known = old[..., 0] >= 0
    there = free | known
    numbers = np.arange(known.size).reshape(known.shape)
    parts = []
    for step, first, second in NEIGHBOURS:
        matters = (free[first] | free[second]) & there[first] & there[second]
        matters &= known[first] | known[second]
        fresh = new[first][matters], new[second][matters]
        before = _both_known(old[first][matters], old[second][matters], step)
        new_second = seams.seen(before[0], fresh[1], step)
        new_first = seams.seen(fresh[0], before[1], step)
        both_old = np.minimum(seams.seen(*before, step), new_first + new_second)
        places = numbers[first][matters], numbers[second][matters]
        parts.append(Pairs(*places, both_old, new_second, new_first))
    pairs = Pairs(*map(np.concatenate, zip(*parts, strict=True)))
    shown = least_cut(pairs, (~free).ravel(), (free & ~known).ravel()).reshape(known.shape)
    return np.where(shown[..., np.newaxis], new, old)


def _both_known(
    first: Integers, second: Integers, step: tuple[int, int]
) -> tuple[Integers, Integers]:
    """Return spots of neighbours; what is not known of a pair goes on from what is."""
    move = np.array([0, *step])
    return (
        np.where(first[..., :1] < 0, second - move, first),
        np.where(second[..., :1] < 0, first + move, second),
    )
