import numpy as np

from worker.images.spreading import spread


def test_holes_take_the_mean_of_their_block_and_the_rest_stays():
    pixels = np.arange(16, dtype=np.float32).reshape(4, 4, 1)
    valid = np.ones((4, 4), bool)
    valid[0, 0] = valid[3, 3] = False

    filled = spread(pixels, valid)

    assert filled[0, 0] == (1 + 4 + 5) / 3
    assert filled[3, 3] == np.float32((10 + 11 + 14) / 3)
    np.testing.assert_array_equal(filled[valid], pixels[valid])


def test_a_disc_is_drawn_out_and_nan_round_it_stays_outside():
    y, x = np.mgrid[:37, :53]
    inside = np.hypot(x - 26, y - 18) < 15
    pixels = np.where(inside, x, np.nan).astype(np.float32)[..., None]

    filled = spread(pixels, inside)

    assert np.isfinite(filled).all()
    assert filled.min() >= 11
    assert filled.max() <= 41
    assert filled[18, 0] < 20
    assert filled[18, 52] > 30


def test_nothing_to_spread_changes_nothing():
    pixels = np.ones((3, 5, 2), np.float32)

    assert spread(pixels, np.ones((3, 5), bool)) is pixels
    assert spread(pixels, np.zeros((3, 5), bool)) is pixels
