"""How good a result is, told in numbers: what is copied whole, what repeats, what does not fit.

The distances of patches at several scales agree with the eye; one scale alone does not (a broken
grid of bricks has good small patches).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from worker.synthesis.by_example.copies import continued, copied_so_far
from worker.synthesis.by_example.exact import nearest_distances
from worker.synthesis.by_example.pyramid import halved
from worker.synthesis.by_example.wasserstein import sliced_wasserstein
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.synthesis.by_example.exemplar import Exemplar

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]
    Integers = NDArray[np.int32]
    Figures = dict[str, float | int | None]

_WINDOW = 8
_PATCH = 9
_SAMPLES = 128
_MOST_PIXELS = 2**18


def quality(place: Integers, exemplar: Exemplar) -> Figures:
    """Judge a coordinate map, (height, width, 2), by itself and by the features it gathers.

    Returns:
        `coherent`: the share of pixels that continue what is left of or above them in the exemplar.
        `verbatim`: the share within 8 x 8 windows copied whole. `longest_run`: the longest line of
        pixels copied whole, in pixels. `pieces`: connected pieces copied whole. `repetition`: the
        highest correlation of the result with itself shifted, and `exemplar_repetition`.
        `seam`: the mean step across the borders when tiled, as a multiple of the
        largest such step inside: up to 1 it is not seen. `to_exemplar_<k>`
        and `from_exemplar_<k>`: the mean distance, 0..1, from the result's 9 x 9 patches to the
        exemplar's nearest and the other way round, at 1/k of the size; None where too small or too
        large to tell. `wasserstein_<k>`: how far they are from the exemplar's as a whole, which
        agrees less with the eye.
    """
    rows, columns = np.moveaxis(place, -1, 0)
    made = rows >= 0
    features = exemplar.features[rows, columns]
    across, down = continued(place)
    figures: Figures = {
        "coherent": _share(_either(across, down) & made, made),
        "verbatim": _share(_in_windows(across, down), made),
        "longest_run": int(max(copied_so_far(across).max(), copied_so_far(down.T).max())),
        "pieces": _pieces(across, down, made),
        "repetition": repetition(features),
        "exemplar_repetition": max(map(repetition, exemplar.layout.parts(exemplar.features))),
        "seam": seam(features),
    }
    ours, known = features, made
    theirs, usable = exemplar.features, exemplar.usable
    for scale in (2, 4, 8):
        ours, known = halved(ours, known)
        theirs, usable = halved(theirs, usable)
        figures[f"to_exemplar_{scale}"] = patch_distance(ours, known, theirs, usable)
        figures[f"from_exemplar_{scale}"] = patch_distance(theirs, usable, ours, known)
        figures[f"wasserstein_{scale}"] = sliced_wasserstein(ours, known, theirs, usable, _PATCH)
    return figures


def repetition(features: Bytes) -> float:
    """Return the highest correlation with itself, shifted by at least an eighth of its size.

    The picture is taken to go on around its edges; a flat one has 0.
    """
    grey = features.mean(axis=-1, dtype=np.float64)
    grey -= grey.mean()
    power = np.abs(np.fft.rfft2(grey)) ** 2
    correlation = np.fft.irfft2(power, grey.shape)
    if correlation[0, 0] <= 1e-6 * grey.size:
        return 0.0
    height, width = grey.shape
    lags_y = np.minimum(np.arange(height), height - np.arange(height)) * 8 >= height
    lags_x = np.minimum(np.arange(width), width - np.arange(width)) * 8 >= width
    far = lags_y[:, np.newaxis] | lags_x
    return round(float(np.max(correlation[far], initial=0.0) / correlation[0, 0]), 4)


def seam(features: Bytes) -> float:
    """Return the mean step across a border when tiled, as a multiple of the largest inside."""
    whole = features.astype(np.int16)
    ratios = []
    for axis in (0, 1):
        steps = np.abs(np.diff(whole, axis=axis, append=whole.take([0], axis=axis)))
        means = steps.mean(axis=(1 - axis, 2), dtype=np.float64)
        ratios.append(float(means[-1] / max(means[:-1].max(initial=0.0), 1e-3)))
    return round(max(ratios), 4)


def _either(across: Mask, down: Mask) -> Mask:
    either = across | down
    return np.asarray(either)


def _in_windows(across: Mask, down: Mask) -> Mask:
    """Return the pixels within windows of which all pixels continue each other."""
    if min(across.shape) < _WINDOW:
        return np.zeros(across.shape, bool)
    joined = across[:, 1:]
    rows = whole_windows(joined, (1, _WINDOW - 1))
    whole = whole_windows(rows, (_WINDOW, 1))
    whole &= whole_windows(down[1:], (_WINDOW - 1, 1))[:, : whole.shape[1]]
    spread = np.zeros(across.shape, bool)
    spread[: whole.shape[0], : whole.shape[1]] = whole
    origin = _WINDOW // 2 - 1
    return np.asarray(
        ndimage.maximum_filter(spread, _WINDOW, origin=(origin, origin), mode="constant")
    )


def _pieces(across: Mask, down: Mask, made: Mask) -> int:
    """Count pieces: pixels joined where one continues the other."""
    height, width = made.shape
    grid = np.zeros((2 * height - 1, 2 * width - 1), bool)
    grid[::2, ::2] = made
    grid[::2, 1::2] = across[:, 1:]
    grid[1::2, ::2] = down[1:]
    return int(ndimage.label(grid)[1])


def _share(part: Mask, whole: Mask) -> float:
    return round(float(part.sum() / max(1, whole.sum())), 4)


def patch_distance(ours: Bytes, known: Mask, theirs: Bytes, usable: Mask) -> float | None:
    """Return the mean distance of some of our patches from their nearest."""
    fits = min(*ours.shape[:2], *theirs.shape[:2]) >= 2 * _PATCH
    if not fits or max(ours[..., 0].size, theirs[..., 0].size) > _MOST_PIXELS:
        return None
    candidates = np.flatnonzero(whole_windows(known, (_PATCH, _PATCH)))
    if not candidates.size or not whole_windows(usable, (_PATCH, _PATCH)).any():
        return None
    chosen = candidates[np.linspace(0, candidates.size - 1, _SAMPLES).astype(np.int64)]
    squares = nearest_distances(ours, chosen, theirs, usable, _PATCH)
    distances = np.sqrt(squares / (_PATCH**2 * ours.shape[2])) / 255
    return round(float(distances.mean()), 5)
