"""Discs where a texture is high, none too near to another one, thrown like darts (Cook, 1986).

Places are tried in the order of a hash, on a tile whose edges are joined: a place once taken stays,
so more tries only add to those of fewer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from api_schemas.textures.scatter import TRIES_MAX
from worker.images.image import Image
from worker.numba_kernel import kernel
from worker.outcome import Outcome
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._pointwise import wide

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.scatter import ScatterSpec
    from worker.stages import Report

    Numbers = NDArray[np.float64]

_CELLS_MAX = 128


def synthesize(
    spec: ScatterSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Place discs on `inputs["density"]`: a mask, what tells them apart, and where they are."""
    above = wide(inputs["density"].pixels[..., 0]) >= spec.level
    # Each is drawn of as many as there may ever be, so that more tries begin like fewer
    u, v, chance, grow = (uniforms(spec.seed, use, TRIES_MAX)[: spec.tries] for use in range(4))
    taken = np.empty(spec.most, np.int64)
    taken = taken[: _throw(taken, u, v, above, spec.spacing)]
    smallest, largest = sorted(spec.radius)
    radii = smallest + (largest - smallest) * grow[taken]
    width, height = size
    mask, number, random = (np.zeros((height, width), np.float32) for _ in range(3))
    chances = chance[taken].astype(np.float32)
    _draw(mask, number, random, u[taken], v[taken], radii, chances)
    places = np.stack([u[taken], v[taken], radii], axis=-1)
    return Outcome(
        Image(mask[..., np.newaxis], spec.meaning),
        {
            "number": Image(number[..., np.newaxis], "data"),
            "random": Image(random[..., np.newaxis], "data"),
        },
        {
            "count": len(places),
            "share_above": float(above.mean()),
            "places": [[round(item, 7) for item in place] for place in places.tolist()],
        },
    )


def warm() -> None:
    """Compile the kernels."""
    one = np.full(1, 0.5)
    texel = np.zeros((1, 1), np.float32)
    _throw(np.empty(1, np.int64), one, one, np.ones((1, 1), np.bool_), 0.1)
    _draw(texel, texel.copy(), texel.copy(), one, one, one, texel[0])


@kernel
def _throw(
    taken: NDArray[np.int64], u: Numbers, v: Numbers, above: NDArray[np.bool_], spacing: float
) -> int:
    """Fill `taken` with the tries that stay, and return how many they are."""
    height, width = above.shape
    cells = _CELLS_MAX
    if spacing * cells > 1:
        cells = max(int(1 / spacing), 1)
    # Of each cell its last place, and of each place the one before it in its cell
    last = np.full((cells, cells), -1)
    before = np.full(len(taken), -1)
    reach = 1 if cells >= 3 else 0
    count = 0
    for index in range(len(u)):
        if count == len(taken):
            break
        x, y = u[index], v[index]
        if not above[int((1 - y) * height) % height, int(x * width) % width]:
            continue
        column, row = int(x * cells) % cells, int(y * cells) % cells
        free = True
        for near_row in range(row - reach, row + reach + 1) if reach else range(cells):
            for near in range(column - reach, column + reach + 1) if reach else range(cells):
                other = last[near_row % cells, near % cells]
                while other >= 0 and free:
                    place = taken[other]
                    du, dv = abs(u[place] - x), abs(v[place] - y)
                    du, dv = min(du, 1 - du), min(dv, 1 - dv)
                    free = du * du + dv * dv >= spacing * spacing
                    other = before[other]
        if free:
            taken[count], before[count] = index, last[row, column]
            last[row, column] = count
            count += 1
    return count


@kernel
def _draw(
    mask: NDArray[np.float32],
    number: NDArray[np.float32],
    random: NDArray[np.float32],
    u: Numbers,
    v: Numbers,
    radii: Numbers,
    chances: NDArray[np.float32],
) -> None:
    """Draw discs with an edge of one pixel; of two the later one is on top."""
    height, width = mask.shape
    side = np.sqrt(np.float64(width * height))
    for index in range(len(u)):
        reach = radii[index] + 1 / side
        x, y = u[index] * width, (1 - v[index]) * height
        for row in range(int(np.floor(y - reach * height)), int(np.ceil(y + reach * height))):
            for column in range(int(np.floor(x - reach * width)), int(np.ceil(x + reach * width))):
                du, dv = (column + 0.5 - x) / width, (row + 0.5 - y) / height
                inside = (radii[index] - np.sqrt(du * du + dv * dv)) * side + 0.5
                r, c = row % height, column % width
                if inside > 0:
                    mask[r, c] = max(mask[r, c], np.float32(min(inside, 1.0)))
                if inside >= 0.5:
                    number[r, c] = index + 1
                    random[r, c] = chances[index]
