"""Texture sewn together from square patches along the best of all seams (Kwatra et al., 2003).

Squares are laid in rows, then again and again over the seams. Each is chosen by chance among those
of the exemplar that agree best with what lies there already, and of all ways to show it or what is
there at each pixel the one is taken whose seams, old and new, are seen least. So seams as a whole
become ever less visible once everything is covered.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from worker.outcome import Outcome
from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.placing import Placing, Squares
from worker.synthesis.by_example.result import finished, gathered
from worker.synthesis.by_example.sewing import NEIGHBOURS, Seams, sewn
from worker.synthesis.by_example.views import Views, square

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.graph_cut import GraphCutSpec
    from worker.images.image import Image
    from worker.preview import Progress

    Integers = NDArray[np.int64]

_USE_OF_SHIFTS = 16
"""Those before are of the squares of each pass."""


def synthesize(
    spec: GraphCutSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Progress
) -> Outcome:
    """Sew `spec.size` pixels and bring them to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    views = Views.of(exemplar, turns=spec.turns, flips=spec.flips)
    canvas = _Canvas.of(spec, exemplar)
    placing, seams = Placing(views, canvas.side), Seams.of(views, canvas.side)
    energies: list[int] = []
    for done in range(spec.passes + 1):
        corners = list(canvas.corners(spec.seed, done))
        chances = uniforms(spec.seed, done, len(corners))
        for index, corner in enumerate(corners):
            share = (done + index / len(corners)) / (spec.passes + 1)
            report(share, f"pass {done} of {spec.passes}")
            _lay(canvas, seams, placing, corner, spec.tolerance, chances[index])
        energies.append(_energy(canvas, seams))
        so_far = gathered(views.sources(canvas.result(spec.size)), exemplar.image)
        report((done + 1) / (spec.passes + 1), "so far", so_far)
    spots = canvas.result(spec.size)
    place, turns = views.sources(spots), spots[..., 0]
    made = finished(place, exemplar, inputs, size, turns=turns, normal_range=spec.normal_range)
    return Outcome(made.image, made.layers, {**made.report, "energies": energies})


@dataclass(frozen=True, slots=True)
class _Canvas:
    """Where squares are laid.

    Attributes:
        spots: What each pixel shows, (rows, columns, 3), the view -1 where nothing is known. One
            that does not go on around its edges has a border of one pixel that never is.
        side: Of a square, in pixels.
        step: From one square to the next.
        wraps: Whether it goes on around its edges.
    """

    spots: Integers
    side: int
    step: int
    wraps: bool

    @classmethod
    def of(cls, spec: GraphCutSpec, exemplar: Exemplar) -> _Canvas:
        """Make one for a result; beyond its right and lower edges there may be some more."""
        width, height = spec.size
        # With neighbours around it, a square must not meet itself
        room = max(1, min(width, height) - 2) if spec.tileable else spec.block
        squares = Squares.of(spec, exemplar.usable, room)
        side, overlap, step = squares.side, squares.overlap, squares.step
        rows, columns = (
            length
            if spec.tileable
            else (max(1, -(-(length - overlap) // step)) - 1) * step + side + 2
            for length in (height, width)
        )
        return cls(np.full((rows, columns, 3), -1, np.int64), side, step, spec.tileable)

    def corners(self, seed: int, turn: int) -> Iterator[tuple[int, int]]:
        """Yield rows and columns where squares are laid in a turn, all shifted by chance."""
        shift = (uniforms(seed, _USE_OF_SHIFTS, 2, 2 * turn) * self.step * (turn > 0)).astype(
            np.int64
        )
        last = [length - (1 if self.wraps else self.side + 2) for length in self.spots.shape[:2]]
        for row in range(-int(shift[0]), last[0] + 1, self.step):
            for column in range(-int(shift[1]), last[1] + 1, self.step):
                yield (row, column) if self.wraps else (max(row, 0), max(column, 0))

    def window(self, corner: tuple[int, int]) -> tuple[Integers, Integers]:
        """Return the indices of a square and of the pixels around it."""
        steps = np.arange(self.side + 2)
        before = 1 if self.wraps else 0
        rows, columns = (
            (first - before + steps) % length
            for first, length in zip(corner, self.spots.shape[:2], strict=True)
        )
        return rows[:, np.newaxis], columns

    def result(self, size: list[int]) -> Integers:
        """Return what the pixels show that were asked for, (height, width, 3)."""
        first = 0 if self.wraps else 1
        return self.spots[first : first + size[1], first : first + size[0]]


def _lay(
    canvas: _Canvas,
    seams: Seams,
    placing: Placing,
    corner: tuple[int, int],
    tolerance: float,
    chance: float,
) -> None:
    """Lay one square, and show what of it makes the seams around it least visible."""
    there = canvas.window(corner)
    old = canvas.spots[there]
    known = old[..., 0] >= 0
    inner = np.s_[1:-1, 1:-1]
    before = seams.all_seen(old, known)
    if known[inner].all() and not before.any():
        return
    colours = seams.views.colours(np.where(known[..., np.newaxis], old, 0)[inner])
    new = square(placing.chosen(colours, known[inner], tolerance, chance), canvas.side, 1)
    inside = np.zeros(known.shape, bool)
    inside[inner] = True
    made = sewn(seams, old, new, inside)
    # What was known may have been taken to cost less than it does
    if known[inner].all() and seams.all_seen(made, known).sum() >= before.sum():
        return
    place = tuple(index[1:-1] if index.ndim == 1 else index[1:-1, :] for index in there)
    canvas.spots[place] = made[inner]


def _energy(canvas: _Canvas, seams: Seams) -> int:
    """Return how much is seen of all seams together."""
    total = 0
    for step, _, _ in NEIGHBOURS:
        beside = np.roll(canvas.spots, (-step[0], -step[1]), (0, 1))
        both = (canvas.spots[..., 0] >= 0) & (beside[..., 0] >= 0)
        total += int(seams.seen(canvas.spots[both], beside[both], step).sum())
    return total
