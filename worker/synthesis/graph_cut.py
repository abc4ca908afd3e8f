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
from worker.synthesis.by_example.flow_cut import Pairs, least_cut
from worker.synthesis.by_example.placing import Placing, Squares
from worker.synthesis.by_example.result import finished, gathered
from worker.synthesis.by_example.views import Views, square

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.graph_cut import GraphCutSpec
    from worker.images.image import Image
    from worker.preview import Progress

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]

_USE_OF_SHIFTS = 16
"""Those before are of the squares of each pass."""

_NEIGHBOURS = (((0, 1), np.s_[:, :-1], np.s_[:, 1:]), ((1, 0), np.s_[:-1], np.s_[1:]))


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
    placing = Placing(views, canvas.side)
    energies: list[int] = []
    for done in range(spec.passes + 1):
        corners = list(canvas.corners(spec.seed, done))
        chances = uniforms(spec.seed, done, len(corners))
        for index, corner in enumerate(corners):
            share = (done + index / len(corners)) / (spec.passes + 1)
            report(share, f"pass {done} of {spec.passes}")
            _lay(canvas, views, placing, corner, spec.tolerance, chances[index])
        energies.append(_energy(canvas, views))
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
    views: Views,
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
    if known[inner].all() and not _seams(views, old, known).any():
        return
    colours = views.colours(np.where(known[..., np.newaxis], old, 0)[inner])
    chosen = placing.chosen(colours, known[inner], tolerance, chance)
    new = square(chosen, canvas.side, 1)
    inside = np.zeros(known.shape, bool)
    inside[inner] = True
    numbers = np.arange(known.size).reshape(known.shape)
    parts = []
    for step, first, second in _NEIGHBOURS:
        matters = (inside[first] | inside[second]) & (inside | known)[first]
        matters &= (inside | known)[second] & (known[first] | known[second])
        fresh = new[first][matters], new[second][matters]
        before = _both_known(old[first][matters], old[second][matters], step)
        parts.append(
            Pairs(
                numbers[first][matters],
                numbers[second][matters],
                _seam(views, *before, step),
                _seam(views, before[0], fresh[1], step),
                _seam(views, fresh[0], before[1], step),
            )
        )
    pairs = Pairs(*map(np.concatenate, zip(*parts, strict=True)))
    shown = least_cut(pairs, (~inside).ravel(), (inside & ~known).ravel()).reshape(known.shape)
    place = tuple(index[1:-1] if index.ndim == 1 else index[1:-1, :] for index in there)
    canvas.spots[place] = np.where(shown[..., np.newaxis], new, old)[inner]


def _both_known(
    first: Integers, second: Integers, step: tuple[int, int]
) -> tuple[Integers, Integers]:
    """Return spots of neighbours; what is not known of a pair goes on from what is."""
    move = np.array([0, *step])
    return (
        np.where(first[..., :1] < 0, second - move, first),
        np.where(second[..., :1] < 0, first + move, second),
    )


def _seam(views: Views, first: Integers, second: Integers, step: tuple[int, int]) -> Integers:
    """Return how much is seen of the seam between neighbours, each from a square of its own.

    It is how much the two squares differ at both pixels; that of three squares obeys the triangle
    inequality.
    """
    move = np.array([0, *step])
    apart = np.abs(views.colours(first) - views.colours(second - move))
    apart += np.abs(views.colours(first + move) - views.colours(second))
    return np.asarray(apart.sum(axis=-1))


def _seams(views: Views, spots: Integers, known: Mask) -> Integers:
    """Return how much is seen of each seam among spots, of which only known ones count."""
    found = []
    for step, first, second in _NEIGHBOURS:
        both = known[first] & known[second]
        found.append(_seam(views, spots[first][both], spots[second][both], step))
    return np.concatenate(found)


def _energy(canvas: _Canvas, views: Views) -> int:
    """Return how much is seen of all seams together."""
    total = 0
    for step, _, _ in _NEIGHBOURS:
        beside = np.roll(canvas.spots, (-step[0], -step[1]), (0, 1))
        both = (canvas.spots[..., 0] >= 0) & (beside[..., 0] >= 0)
        total += int(_seam(views, canvas.spots[both], beside[both], step).sum())
    return total
