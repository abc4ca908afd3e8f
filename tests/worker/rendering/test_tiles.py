import numpy as np
import pytest

from api_schemas.estimate import TILE_SIDE
from worker.rendering.tiles import SAMPLES_MAX, Tile, pixels_per_tile, tile_from_picture, tiles


@pytest.mark.parametrize("supersampling", range(1, 9))
def test_tiles_cover_every_pixel_once_within_2048_samples(supersampling: int) -> None:
    width, height = 2050, 2500
    covered = np.zeros((height, width), dtype=int)

    for tile in tiles(width, height, supersampling):
        covered[tile.bottom : tile.bottom + tile.height, tile.left : tile.left + tile.width] += 1
        assert max(tile.width, tile.height) * supersampling <= 2048

    assert (covered == 1).all()


def test_the_estimate_knows_the_largest_tile() -> None:
    assert TILE_SIDE == SAMPLES_MAX


@pytest.mark.parametrize("supersampling", range(1, 9))
def test_tiles_cut_no_block_of_derivatives(supersampling: int) -> None:
    assert pixels_per_tile(supersampling) * supersampling % 2 == 0


def test_a_tile_sees_its_part_of_the_picture() -> None:
    matrix = tile_from_picture(Tile(left=30, bottom=10, width=20, height=40), 100, 50)

    # Pixel (x, y) of the picture is at clip 2 x / width - 1; the tile's corners go to -1 and 1.
    np.testing.assert_allclose(
        matrix @ [2 * 30 / 100 - 1, 2 * 10 / 50 - 1, 0.5, 1], [-1, -1, 0.5, 1], atol=1e-15
    )
    np.testing.assert_allclose(matrix @ [0, 1, 0.5, 1], [1, 1, 0.5, 1], atol=1e-15)
