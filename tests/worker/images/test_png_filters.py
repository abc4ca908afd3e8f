import numpy as np

from worker.images.png_filters import choose_png_filter


def test_a_flat_picture_is_not_filtered() -> None:
    assert choose_png_filter(np.full((64, 64, 3), 200, np.uint8)) == "none"


def test_a_dither_of_two_codes_is_not_filtered() -> None:
    dither = np.random.default_rng(3).choice(np.array([40, 90], np.uint8), (64, 64, 1))

    assert choose_png_filter(dither) == "none"  # differences would have three values


def test_a_smooth_ramp_becomes_differences_along_it() -> None:
    rows, columns = np.indices((256, 256))
    across = (columns + rows**2).astype(np.uint8)[..., None]
    down = across.transpose(1, 0, 2)

    assert choose_png_filter(np.ascontiguousarray(across)) == "sub"
    assert choose_png_filter(np.ascontiguousarray(down)) == "up"


def test_differences_are_between_whole_texels() -> None:
    columns = np.arange(256, dtype=np.uint16) * 257
    picture = np.stack([columns, columns[::-1], columns * 3], axis=1)[None].repeat(3, axis=0)
    picture[1] += 30000  # so that the row above is no help

    assert choose_png_filter(picture) == "sub"


def test_a_single_texel_has_a_filter_too() -> None:
    assert choose_png_filter(np.zeros((1, 1, 4), np.uint16)) == "none"
