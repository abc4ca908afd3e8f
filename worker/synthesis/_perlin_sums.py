"""Octaves of noise that are not just added: turbulence and multifractals, at points and on grids.

What an octave gives fades, where pixels cannot show it, to what it gives on average: the picture
becomes smooth and not darker.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worker.numba_kernel import kernel, parallel_kernel, prange
from worker.synthesis._perlin_octaves import SHIFT_UNITS
from worker.synthesis._perlin_points import gradient_noise

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from api_schemas.textures.perlin import PerlinSpec
    from worker.synthesis._perlin_octaves import Octave

    Floats = NDArray[np.float32]
    Numbers = NDArray[np.float64]

KINDS = {"fbm": 0, "turbulence": 1, "billow": 1, "ridged": 2, "multifractal": 3}
# Of |n| and n^2 over all cells, with the quintic fade: measured at 8e6 points
MEANS = {
    "eight": (0.1745, 0.0457),
    "reference": (0.2043, 0.0639),
    "solid": (0.2220, 0.0741),
    "time": (0.2374, 0.0854),
}
_CHUNK = 1 << 14


class Folding(NamedTuple):
    """How the octaves of one spec come together.

    Attributes:
        kind: One of KINDS.
        start: The sum before the first octave.
        rest: What a sum of turbulence or crests adds on average, for an octave that is not seen.
        scale: What the sum is multiplied by at the end.
        bias: What is added to it then.
    """

    kind: int
    start: float
    rest: float
    scale: float
    bias: float


def folding(spec: PerlinSpec, gradients: str) -> Folding:
    """Return how the octaves of a spec come together; `gradients` is a name of GRADIENTS."""
    absolute, square = MEANS[gradients]
    unit = spec.range == "unit"
    if spec.sum == "fbm":
        return Folding(0, 0.0, 0.0, *((0.5, 0.5) if unit else (1.0, 0.0)))
    if spec.sum == "turbulence":
        return Folding(1, 0.0, absolute, 1.0, 0.0)
    if spec.sum == "billow":
        return Folding(1, 0.0, absolute, *((1.0, 0.0) if unit else (2.0, -1.0)))
    if spec.sum == "ridged":
        return Folding(2, 0.0, 1 - 2 * absolute + square, 1.0, 0.0)
    most = float(np.prod([1 + spec.gain**n for n in range(spec.octaves)]))
    return Folding(3, 1.0, 0.0, 1 / most if unit else 1.0, 0.0)


def fold(
    values: Floats,
    octaves: Sequence[Octave],
    how: Folding,
    fill: Callable[[Floats, Octave], None],
) -> None:
    """Bring octaves together on a grid, one after the other, and write the result.

    Args:
        values: Of any shape.
        octaves: All of them.
        how: One that does not just add.
        fill: Writes the noise of one octave into an array of that shape.
    """
    noise = np.zeros(values.shape, np.float32)
    carried = np.ones(values.shape, np.float32)
    values.fill(how.start)
    for octave in octaves:
        if octave.visibility > 0:
            fill(noise, octave)
        gain = octave.gain if how.kind == KINDS["multifractal"] else octave.share
        _fold_grid(
            values.reshape(-1),
            noise.reshape(-1),
            carried.reshape(-1),
            how.kind,
            gain,
            octave.visibility,
            how.rest,
        )
    values *= np.float32(how.scale)
    values += np.float32(how.bias)


def octave_table(octaves: Sequence[Octave], how: Folding) -> Numbers:
    """Return what `fill_noise_at` needs of octaves, a row for each that adds anything."""
    multifractal = how.kind == KINDS["multifractal"]
    rows = [
        (
            octave.cells,
            octave.beats,
            octave.layer,
            octave.gain if multifractal else octave.share,
            octave.visibility,
            *np.divide(octave.shift, SHIFT_UNITS),
        )
        for octave in octaves
        if octave.visibility > 0 or how.kind in (KINDS["turbulence"], KINDS["ridged"])
    ]
    return np.array(rows, np.float64).reshape(-1, 8)


@parallel_kernel
def fill_noise_at(
    values: Numbers,
    slopes: Numbers,
    places: Numbers,
    axes: int,
    octaves: Numbers,
    how: Folding,
    table: NDArray[np.int32],
    gradients: Numbers,
    fade: Numbers,
) -> None:
    """Write values (n,) and their derivatives (n, 4) at places (n, 4) in tiles and turns of time.

    A row of `octaves` is one of `octave_table`.
    """
    for chunk in prange((len(values) + _CHUNK - 1) // _CHUNK):
        place, slope = np.empty(4), np.empty(4)
        work = np.empty((4, 4))
        carried_slope = np.empty(4)
        for point in range(chunk * _CHUNK, min(len(values), (chunk + 1) * _CHUNK)):
            total, carried = how.start, 1.0
            total_slope = slopes[point]
            total_slope[:] = 0.0
            carried_slope[:] = 0.0
            for n in range(len(octaves)):
                cells, beats, layer, gain, visible = octaves[n, :5]
                for axis in range(3):
                    place[axis] = places[point, axis] * cells + octaves[n, 5 + axis]
                place[3] = places[point, 3] * beats
                noise = 0.0
                slope[:] = 0.0
                if visible > 0:
                    noise = gradient_noise(
                        place,
                        axes,
                        int(layer),
                        int(cells),
                        int(beats),
                        table,
                        gradients,
                        fade,
                        slope,
                        work,
                    )
                before, held = total, carried
                total, carried = _folded(total, carried, noise, how.kind, gain, visible, how.rest)
                sign = -1.0 if noise < 0 else 1.0
                for axis in range(4):
                    rise = visible * slope[axis] * (beats if axis == 3 else cells)
                    if how.kind == 0:
                        total_slope[axis] += gain * rise
                    elif how.kind == 1:
                        total_slope[axis] += gain * sign * rise
                    elif how.kind == 2:
                        crest = visible * (1 - abs(noise)) ** 2 + (1 - visible) * how.rest
                        fall = -2 * (1 - abs(noise)) * sign * rise
                        term = held * fall + carried_slope[axis] * crest
                        total_slope[axis] += gain * term
                        carried_slope[axis] = 2 * term if 0 < carried < 1 else 0.0
                    else:
                        factor = 1 + gain * visible * noise
                        total_slope[axis] = total_slope[axis] * factor + before * gain * rise
            values[point] = total * how.scale + how.bias
            total_slope *= how.scale


@parallel_kernel
def _fold_grid(
    values: Floats,
    noise: Floats,
    carried: Floats,
    kind: int,
    gain: float,
    visible: float,
    rest: float,
) -> None:
    for chunk in prange((len(values) + _CHUNK - 1) // _CHUNK):
        for i in range(chunk * _CHUNK, min(len(values), (chunk + 1) * _CHUNK)):
            values[i], carried[i] = _folded(
                values[i], carried[i], noise[i], kind, gain, visible, rest
            )


@kernel
def _folded(
    total: float,
    carried: float,
    noise: float,
    kind: int,
    gain: float,
    visible: float,
    rest: float,
) -> tuple[float, float]:
    """Return the sum with another octave in it, and what that octave lets through of the next."""
    if kind == 0:
        return total + gain * visible * noise, carried
    if kind == 1:
        return total + gain * (visible * abs(noise) + (1 - visible) * rest), carried
    if kind == 2:
        crest = visible * (1 - abs(noise)) ** 2 + (1 - visible) * rest
        term = carried * crest
        return total + gain * term, min(max(2 * term, 0.0), 1.0)
    return total * (1 + gain * visible * noise), carried
