import itertools

import numpy as np
import pytest

from api_schemas.output import Layer, RenderOutput
from api_schemas.output_cost import SAMPLES_PER_LAYERED_TILE, SAMPLES_PER_TILE, tiles_of
from worker.rendering.tiles import (
    LAYERED_SAMPLES_MAX,
    SAMPLES_MAX,
    Tile,
    bands,
    tile_from_picture,
    tile_size,
)

SIZES = [(1, 1), (2050, 2500), (16384, 3), (3, 16384), (16384, 16384), (5461, 5461)]
CUTS = list(itertools.product(SIZES, range(1, 9), [SAMPLES_MAX, LAYERED_SAMPLES_MAX]))


@pytest.mark.parametrize(("picture", "supersampling", "most"), CUTS)
def test_bands_of_tiles_cover_every_pixel_once_from_the_top(
    picture: tuple[int, int], supersampling: int, most: int
) -> None:
    width, height = picture
    top = height
    for tiles in bands(width, height, tile_size(width, height, supersampling, most)):
        assert {tile.bottom + tile.height for tile in tiles} == {top}
        left = 0
        for tile in tiles:
            assert tile.left == left
            left += tile.width
        assert left == width
        assert len({tile.bottom for tile in tiles}) == 1
        top = tiles[0].bottom

    assert top == 0


@pytest.mark.parametrize(("picture", "supersampling", "most"), CUTS)
def test_a_tile_fits_a_framebuffer_and_the_memory(
    picture: tuple[int, int], supersampling: int, most: int
) -> None:
    width, height = tile_size(*picture, supersampling, most)

    assert max(width, height) * supersampling <= 16384  # the largest framebuffer of llvmpipe
    assert width * height * supersampling**2 <= most
    for side, whole in ((width, picture[0]), (height, picture[1])):
        assert side == whole or side * supersampling % 2 == 0  # no block of derivatives is cut


@pytest.mark.parametrize(("picture", "supersampling", "most"), CUTS)
def test_the_estimate_knows_the_number_of_tiles(
    picture: tuple[int, int], supersampling: int, most: int
) -> None:
    size = tile_size(*picture, supersampling, most)
    count = sum(len(tiles) for tiles in bands(*picture, size))
    layers: list[Layer] = ["depth"] if most == LAYERED_SAMPLES_MAX else []
    output = RenderOutput(size=list(picture), supersampling=supersampling, layers=layers)

    assert 0.75 * count <= tiles_of(output) <= count


def test_the_estimate_knows_the_largest_tile() -> None:
    assert (SAMPLES_PER_TILE, SAMPLES_PER_LAYERED_TILE) == (SAMPLES_MAX, LAYERED_SAMPLES_MAX)


def test_what_fits_one_tile_is_one_tile() -> None:
    assert tile_size(2048, 2048, 1, SAMPLES_MAX) == (2048, 2048)
    assert tile_size(512, 512, 4, SAMPLES_MAX) == (512, 512)
    assert tile_size(16384, 256, 1, SAMPLES_MAX) == (16384, 256)


def test_a_tile_sees_its_part_of_the_picture() -> None:
    matrix = tile_from_picture(Tile(left=30, bottom=10, width=20, height=40), 100, 50)

    # Pixel (x, y) of the picture is at clip 2 x / width - 1; the tile's corners go to -1 and 1.
    np.testing.assert_allclose(
        matrix @ [2 * 30 / 100 - 1, 2 * 10 / 50 - 1, 0.5, 1], [-1, -1, 0.5, 1], atol=1e-15
    )
    np.testing.assert_allclose(matrix @ [0, 1, 0.5, 1], [1, 1, 0.5, 1], atol=1e-15)
