"""Wang tiles cut from an exemplar (Cohen et al., 2003; Lagae and Dutre, 2006).

Kinds of corners are strewn by chance, and between any four there is a tile: an edge is of the kind
that its two corners name. All tiles of the kinds are there, so nothing else restricts the order.
Corners at the rim of the picture are those opposite.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from worker.errors import RenderError
from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis._counter_hash import uniforms
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.result import finished
from worker.synthesis.by_example.tile_set import Corners, TileSet
from worker.synthesis.by_example.windows import whole_windows

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.wang_tiles import WangTilesSpec
    from worker.stages import Report

    Integers = NDArray[np.int64]

_USE_OF_KINDS, _USE_OF_VARIANTS = 2**31, 2**31 + 1
"""Those before are of the squares of the tiles."""


def synthesize(
    spec: WangTilesSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Cut tiles of `inputs["input"]`, lay them, and bring them to (width, height).

    Raises:
        RenderError: Nowhere in the exemplar a square as large as a tile may be copied.
    """
    exemplar = Exemplar.of({"exemplar": inputs["input"]})
    columns, rows = spec.tiles
    numbers = numbers_of(rows, columns, spec)
    used, places = np.unique(numbers, return_inverse=True)
    tiles = tiles_of(exemplar, spec, used, report)
    side = 2 * spec.half_side
    laid = tiles[places.reshape(rows, columns)].transpose(0, 2, 1, 3, 4)
    place = laid.reshape(rows * side, columns * side, 2)
    made = finished(place, exemplar, {}, size)
    width, height = size
    shown = numbers[np.ix_(np.arange(height) * rows // height, np.arange(width) * columns // width)]
    layer = Image(shown.astype(np.float32)[..., np.newaxis], "data")
    return Outcome(
        made.image, {**made.layers, "tile": layer}, {**made.report, "tiles_used": len(used)}
    )


def numbers_of(rows: int, columns: int, spec: WangTilesSpec) -> Integers:
    """Return the number of each tile, (rows, columns), of corners picked by chance."""
    count = rows * columns
    kinds, variants = (
        (uniforms(spec.seed, use, count) * choices).astype(np.int64).reshape(rows, columns)
        for use, choices in ((_USE_OF_KINDS, spec.kinds), (_USE_OF_VARIANTS, spec.variants))
    )
    right, below = np.roll(kinds, -1, 1), np.roll(kinds, -1, 0)
    numbers = kinds
    for kind in (right, np.roll(right, -1, 0), below):
        numbers = numbers * spec.kinds + kind
    return numbers * spec.variants + variants


def corners_of(number: int, spec: WangTilesSpec) -> Corners:
    """Return the corners of a tile."""
    kinds = np.unravel_index(number // spec.variants, (spec.kinds,) * 4)
    return Corners(*(int(kind) for kind in kinds))


def tiles_of(
    exemplar: Exemplar, spec: WangTilesSpec, numbers: Integers, report: Report
) -> NDArray[np.int32]:
    """Return rows and columns in the exemplar of the pixels of tiles, (tiles, side, side, 2).

    An exemplar smaller than a tile goes on around its edges.

    Raises:
        RenderError: Nowhere in it a square as large as a tile may be copied.
    """
    side = 2 * spec.half_side
    lengths = [n if n >= side else n + side - 1 for n in exemplar.shape]
    rows, columns = (np.arange(n) % of for n, of in zip(lengths, exemplar.shape, strict=True))
    whole = np.ix_(rows, columns)
    around = replace(
        exemplar,
        image=Image(exemplar.image.pixels[whole], exemplar.image.meaning),
        usable=exemplar.usable[whole],
        features=exemplar.features[whole],
    )
    if not whole_windows(around.usable, (side, side)).any():
        raise RenderError(
            f"alpha leaves no square of {side} x {side} pixels of the exemplar, as large as a tile",
            code="exemplar_unusable",
        )
    report(0.0, "cutting corners and edges")
    tiles = TileSet(around, side, spec.kinds, spec.seed)
    found = np.empty((len(numbers), side, side, 2), np.int32)
    for index, number in enumerate(numbers):
        report((1 + index) / (1 + len(numbers)), "cutting tiles")
        spots = tiles.tile(corners_of(int(number), spec))
        found[index] = spots[..., 1:] % exemplar.shape
    return found
