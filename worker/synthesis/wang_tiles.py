"""Wang tiles cut from an exemplar (Cohen et al., 2003).

A kind of edge is a square piece of the exemplar, in whose middle the edge runs: of two tiles that
meet there each shows its half. Within a tile pieces meet along the diagonals, where the seam that
differs least is cut (Efros and Freeman, 2001). Of some choices of pieces the one with the least
seams is taken. All sixteen tiles of two kinds for each direction are there, so that the kinds of
all edges of a tiling may be picked by chance; edges at the rim of the picture are those opposite.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from api_schemas.textures.wang_tiles import TRIES
from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis._counter_hash import hashes
from worker.synthesis._resample import resample
from worker.synthesis._seams import least_seam
from worker.synthesis._seams import warm as warm_seams

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.wang_tiles import WangTilesSpec
    from worker.stages import Report

Pixels: TypeAlias = "NDArray[np.float32]"

_USE_OF_PIECES, _USE_OF_ROWS, _USE_OF_COLUMNS = 0, 1, 2


def synthesize(
    spec: WangTilesSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Cut tiles of `inputs["input"]`, lay them, and bring them to (width, height)."""
    image = inputs["input"]
    tiles, seam = tile_set(image.pixels, spec.half_side, spec.seed)
    columns, rows = spec.tiles
    numbers = numbers_of(rows, columns, spec.seed)
    side = 2 * spec.half_side
    laid = tiles[numbers].transpose(0, 2, 1, 3, 4).reshape(rows * side, columns * side, -1)
    width, height = size
    shown = numbers[np.ix_(np.arange(height) * rows // height, np.arange(width) * columns // width)]
    return Outcome(
        Image(resample(np.ascontiguousarray(laid), size), image.meaning),
        {"tile": Image(shown.astype(np.float32)[..., np.newaxis], "data")},
        {"tiles_used": len(np.unique(numbers)), "seam_error": seam},
    )


def numbers_of(rows: int, columns: int, seed: int) -> NDArray[np.int64]:
    """Return the number of each tile, (rows, columns): its edges' kinds, picked by chance."""
    count = rows * columns
    top, left = (
        (hashes(seed, use, count) >> np.uint64(63)).astype(np.int64).reshape(rows, columns)
        for use in (_USE_OF_ROWS, _USE_OF_COLUMNS)
    )
    numbers: NDArray[np.int64] = 8 * top + 4 * np.roll(left, -1, 1) + 2 * np.roll(top, -1, 0) + left
    return numbers


def tile_set(exemplar: Pixels, half: int, seed: int) -> tuple[Pixels, float]:
    """Return all tiles by number, (16, side, side, channels), and their seams' mean error."""
    found: tuple[float, list[Pixels]] | None = None
    for attempt in range(TRIES):
        pieces = _pieces(exemplar, half, seed, attempt)
        quarters = {key: _quarter(pieces, half, *key) for key in np.ndindex(2, 2, 2, 2)}
        error = float(sum(cost for _, cost in quarters.values())) / len(quarters)
        if found is None or error < found[0]:
            tiles = [
                _tile({key: quarter for key, (quarter, _) in quarters.items()}, number)
                for number in range(16)
            ]
            found = (error, tiles)
    assert found is not None
    return np.stack(found[1]), found[0]


def warm() -> None:
    """Compile the kernels."""
    warm_seams()


def _pieces(exemplar: Pixels, half: int, seed: int, attempt: int) -> Pixels:
    """Return a square around each kind of edge, (direction, kind, side, side, channels).

    Direction 0 is edges that run along u.
    """
    height, width, _ = exemplar.shape
    side = np.arange(2 * half)
    random = hashes(seed, _USE_OF_PIECES, 8 * TRIES)[8 * attempt : 8 * attempt + 8]
    tops = random[:4] % np.uint64(max(height - 2 * half, 0) + 1)
    lefts = random[4:] % np.uint64(max(width - 2 * half, 0) + 1)
    cut = [
        exemplar[np.ix_((int(top) + side) % height, (int(left) + side) % width)]
        for top, left in zip(tops, lefts, strict=True)
    ]
    return np.stack(cut).reshape(2, 2, 2 * half, 2 * half, -1)


def _quarter(
    pieces: Pixels, half: int, lower: int, right: int, along: int, beside: int
) -> tuple[Pixels, float]:
    """Return a quarter of tiles: where the piece of a horizontal edge meets that of a vertical one.

    Args:
        pieces: From `_pieces`.
        half: Side of a quarter.
        lower: Whether it is a lower quarter.
        right: Whether it is a right one.
        along: Kind of the edge above or below.
        beside: Kind of the edge left or right.
    """
    first, second = np.s_[:half], np.s_[half:]
    horizontal = pieces[0, along, first if lower else second, second if right else first]
    vertical = pieces[1, beside, second if lower else first, first if right else second]
    # In the mirror every corner is the upper left one
    rows = np.s_[::-1] if lower else np.s_[:]
    columns = np.s_[::-1] if right else np.s_[:]
    horizontal, vertical = horizontal[rows, columns], vertical[rows, columns]
    apart = ((horizontal.astype(np.float64) - vertical) ** 2).sum(axis=-1)
    mask, cost = least_seam(apart)
    quarter = np.where(mask[..., np.newaxis], horizontal, vertical)
    return quarter[rows, columns], cost


def _tile(quarters: Mapping[tuple[int, ...], Pixels], number: int) -> Pixels:
    top, right, bottom, left = (number >> bit & 1 for bit in (3, 2, 1, 0))
    upper = np.concatenate([quarters[0, 0, top, left], quarters[0, 1, top, right]], axis=1)
    lower = np.concatenate([quarters[1, 0, bottom, left], quarters[1, 1, bottom, right]], axis=1)
    return np.concatenate([upper, lower])
