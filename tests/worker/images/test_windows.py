import numpy as np
import PIL.Image
import pytest

from worker.images.windows import Window, place, turn


def test_equal_windows_change_nothing() -> None:
    pixels = np.arange(6, dtype=np.float32).reshape(2, 3, 1)

    assert place(pixels, Window(4, 5, 3, 2), Window(4, 5, 3, 2)) is pixels


@pytest.mark.parametrize(
    ("data", "shown"),
    [
        (Window(1, 1, 2, 2), [[0, 0, 0], [0, 1, 2], [0, 3, 4]]),  # crops nothing, pads
        (Window(-1, -1, 2, 2), [[4, 0, 0], [0, 0, 0], [0, 0, 0]]),  # only its last texel shows
        (Window(2, 0, 2, 2), [[0, 0, 1], [0, 0, 3], [0, 0, 0]]),
        (Window(7, 0, 2, 2), [[0, 0, 0], [0, 0, 0], [0, 0, 0]]),  # beside the picture
    ],
)
def test_texels_land_where_the_windows_overlap(data: Window, shown: list[list[int]]) -> None:
    pixels = np.array([[[1], [2]], [[3], [4]]], np.float32)

    assert place(pixels, data, Window(0, 0, 3, 3))[..., 0].tolist() == shown


@pytest.mark.parametrize("orientation", range(1, 9))
def test_turning_agrees_with_an_independent_reader(orientation: int) -> None:
    codes = np.random.default_rng(2).integers(0, 256, (4, 6, 3), np.uint8)
    picture = PIL.Image.fromarray(codes)
    # Pillow's own table, ImageOps.exif_transpose.
    turns = {
        2: PIL.Image.Transpose.FLIP_LEFT_RIGHT,
        3: PIL.Image.Transpose.ROTATE_180,
        4: PIL.Image.Transpose.FLIP_TOP_BOTTOM,
        5: PIL.Image.Transpose.TRANSPOSE,
        6: PIL.Image.Transpose.ROTATE_270,
        7: PIL.Image.Transpose.TRANSVERSE,
        8: PIL.Image.Transpose.ROTATE_90,
    }
    expected = picture.transpose(turns[orientation]) if orientation > 1 else picture

    assert np.array_equal(turn(codes, orientation), np.asarray(expected))


def test_an_unknown_orientation_means_upright() -> None:
    codes = np.arange(6, dtype=np.uint8).reshape(2, 3, 1)

    assert np.array_equal(turn(codes, 77), codes)
