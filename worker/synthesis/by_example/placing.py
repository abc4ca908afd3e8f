"""Which square of an exemplar fits best over what is there already: all are tried.

The squared differences of a square to every place of the exemplar are correlations, so Fourier
transforms find them at once (Kwatra et al., 2003). They are whole numbers below 2^40, of which the
transforms are off by less than a thousandth: rounded they are exact, on every machine.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy import fft

from worker.errors import RenderError
from worker.synthesis.by_example.windows import fitting_side, whole_windows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.sewn import SewnSpec
    from worker.synthesis.by_example.views import Views

    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int64]
    Numbers = NDArray[np.float64]
    Spectrum = NDArray[np.complex128]

_MOST_SQUARES = 100_000
NEVER = np.iinfo(np.int64).max


@dataclass(frozen=True, slots=True)
class Squares:
    """How large squares are that are laid over each other.

    Attributes:
        side: In pixels.
        overlap: How many of them lie over the neighbour.
    """

    side: int
    overlap: int

    @classmethod
    def of(cls, spec: SewnSpec, usable: Mask, room: int) -> Squares:
        """Return the largest squares that what is usable has, up to what is asked and to `room`.

        Raises:
            RenderError: They are so small that too many were needed.
        """
        side = fitting_side(usable, (room, room), spec.block)
        squares = cls(side, min(max(1, round(spec.overlap * side)), side // 2))
        needed = math.prod(length / squares.step for length in spec.size)
        if needed > _MOST_SQUARES:
            width, height = spec.size
            raise RenderError(
                f"alpha and mask leave squares of {side} x {side} pixels: {width} x {height} would "
                f"take {needed:.0f} of them, and {_MOST_SQUARES} are allowed",
                code="exemplar_unusable",
            )
        return squares

    @property
    def step(self) -> int:
        """Pixels from one square to the next."""
        return self.side - self.overlap


class Placing:
    """The squares of all views of an exemplar, ready to be compared."""

    def __init__(self, views: Views, side: int) -> None:
        """Transform the views; at least one square of `side` pixels must be usable."""
        self._side = side
        self._names = views.names
        self._allowed = [whole_windows(usable, (side, side)) for usable in views.usable]
        self._spectra = [_Spectra(views.planes(view)) for view in views.names]

    def chosen(
        self, old: Integers, over: Mask, tolerance: float, chance: float
    ) -> tuple[int, int, int]:
        """Return the upper left spot of a square that is about as good as the best.

        Args:
            old: Features of what is there, (side, side, channels).
            over: Where it is known, (side, side); where nothing is, all squares are as good.
            tolerance: How much worse than the best a square may be.
            chance: Decides among these, 0 <= chance < 1.
        """
        found = self.costs(old, over)
        costs = np.concatenate([costs.ravel() for costs in found])
        near = np.flatnonzero(costs <= costs.min() * (1 + tolerance))
        pick = int(near[int(chance * len(near))])
        for view, differences in zip(self._names, found, strict=True):
            if pick < differences.size:
                row, column = divmod(pick, differences.shape[1])
                return view, row, column
            pick -= differences.size
        raise AssertionError("unreachable")

    def costs(self, old: Integers, over: Mask) -> list[Integers]:
        """Return, for each view, the squared difference of all squares to what is there.

        By their upper left pixels, (rows, columns); NEVER where one may not be copied.

        Args:
            old: Features of what is there, (side, side, channels).
            over: Where it is known, (side, side).
        """
        return [
            np.where(allowed, spectra.differences(old, over), NEVER)
            for allowed, spectra in zip(self._allowed, self._spectra, strict=True)
        ]


class _Spectra:
    """One view: transforms of its channels, and of the sum of their squares."""

    def __init__(self, planes: Numbers) -> None:
        self._size = planes.shape[1:]
        self._shape = [fft.next_fast_len(length, real=True) for length in self._size]
        self._planes = fft.rfft2(planes, self._shape)
        self._squares = fft.rfft2((planes**2).sum(axis=0), self._shape)

    def differences(self, old: Integers, over: Mask) -> Integers:
        """Return the squared difference to the square at each place where one fits."""
        height, width = (length - len(over) + 1 for length in self._size)
        if not over.any():
            return np.zeros((height, width), np.int64)
        known = np.where(over[..., np.newaxis], old, 0).astype(np.float64)
        theirs = fft.rfft2(np.moveaxis(known, -1, 0), self._shape)
        spectrum: Spectrum = self._squares * fft.rfft2(over.astype(np.float64), self._shape).conj()
        spectrum -= 2 * (self._planes * theirs.conj()).sum(axis=0)
        sums = fft.irfft2(spectrum, self._shape)[:height, :width]
        return np.asarray(np.rint(sums + (known**2).sum()), np.int64)
