import numpy as np
import pytest

from worker.images.display import display_codes
from worker.images.image import Image


def picture(*channels: float, meaning: str = "colour", size: tuple[int, int] = (1, 1)) -> Image:
    return Image(np.full((*size, len(channels)), channels, np.float32), meaning)  # type: ignore[arg-type]


def test_colour_is_divided_by_alpha_before_the_curve() -> None:
    # Straight .5 encodes to 188 (187.5), 1 to 255; alpha itself has no curve: 63.75.
    codes = display_codes(picture(0.125, 0.25, 0, 0.25), 8, "srgb", 0, "none")

    assert codes.tolist() == [[[188, 255, 0, 64]]]


def test_exposure_and_tone_curve_change_colour_and_leave_alpha() -> None:
    light = picture(0.5, 0.5, 0.5, 0.5)  # straight 1

    assert display_codes(light, 8, "linear", -1, "none").tolist() == [[[128, 128, 128, 128]]]
    assert display_codes(light, 8, "linear", 1, "reinhard").tolist() == [[[170, 170, 170, 128]]]
    assert display_codes(light, 8, "linear", 0, "aces").tolist() == [[[205, 205, 205, 128]]]


def test_grey_with_alpha_is_treated_as_colour_with_alpha() -> None:
    assert display_codes(picture(0.25, 0.25), 8, "linear", 1, "reinhard").tolist() == [[[170, 64]]]


def test_data_keeps_its_numbers_whatever_the_exposure() -> None:
    numbers = picture(0.2, 0.4, 0.6, 0.2, meaning="data")

    assert display_codes(numbers, 8, "linear", 3, "aces").tolist() == [[[51, 102, 153, 51]]]


@pytest.mark.parametrize("size", [(301, 1), (301, 300), (3, 70000)])
def test_every_row_is_shown_however_rows_fall_into_blocks(size: tuple[int, int]) -> None:
    rows = np.linspace(0, 1, size[0], dtype=np.float32)[:, None, None]
    image = Image(np.ascontiguousarray(np.broadcast_to(rows, (*size, 1))), "data")

    codes = display_codes(image, 16, "linear", 0, "none")

    assert codes.dtype == np.uint16
    assert np.array_equal(codes, np.rint(image.pixels.astype(np.float64) * 65535))
