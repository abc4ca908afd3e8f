import numpy as np
import pytest

from worker.images.linearise import linearise

HALF_GREY = ((128 / 255 + 0.055) / 1.055) ** 2.4  # IEC 61966-2-1


def texel(*codes: float, kind: type = np.uint8) -> np.ndarray:
    return np.array([[codes]], kind)


def test_straight_srgb_colour_is_decoded_before_it_is_multiplied() -> None:
    pixels = linearise(texel(128, 255, 0, 51), "srgb", "straight", "colour")

    assert pixels[0, 0] == pytest.approx([HALF_GREY * 0.2, 0.2, 0, 0.2], rel=1e-6)


def test_associated_srgb_colour_is_divided_decoded_and_multiplied() -> None:
    stored = texel(64, 127.5, 0, 127.5, kind=np.float32) / 255

    pixels = linearise(stored, "srgb", "associated", "colour")

    assert pixels[0, 0] == pytest.approx([HALF_GREY / 2, 0.5, 0, 0.5], rel=1e-6)


def test_linear_colour_is_associated_exactly_once() -> None:
    codes = texel(255, 51, 0, 51)

    straight = linearise(codes, "linear", "straight", "colour")
    associated = linearise(codes, "linear", "associated", "colour")

    assert straight[0, 0] == pytest.approx([0.2, 0.04, 0, 0.2], rel=1e-6)
    assert associated[0, 0] == pytest.approx([1, 0.2, 0, 0.2], rel=1e-6)


@pytest.mark.parametrize("alpha", ["straight", "associated"])
def test_data_is_never_multiplied(alpha: str) -> None:
    codes = texel(255, 51, 0, 51)

    numbers = linearise(codes, "linear", alpha, "data")  # type: ignore[arg-type]
    decoded = linearise(codes, "srgb", alpha, "data")  # type: ignore[arg-type]

    assert numbers[0, 0] == pytest.approx([1, 0.2, 0, 0.2], rel=1e-6)
    assert decoded[0, 0, 3] == pytest.approx(0.2, rel=1e-6)  # alpha never has a curve


def test_float_numbers_stay_what_they_are() -> None:
    values = texel(4.0, -1.0, 1e30, kind=np.float32)

    linear = linearise(values.copy(), "linear", "none", "colour")
    decoded = linearise(values.copy(), "srgb", "none", "colour")

    four = ((4 + 0.055) / 1.055) ** 2.4
    assert linear.tolist() == values.tolist()
    assert decoded[0, 0, 0] == pytest.approx(four, rel=1e-6)


@pytest.mark.parametrize("size", [(301, 300), (3, 70000)])
def test_every_row_is_decoded_however_rows_fall_into_blocks(size: tuple[int, int]) -> None:
    codes = np.random.default_rng(8).integers(0, 256, (*size, 4), np.uint8)

    numbers = linearise(codes, "linear", "straight", "data")

    assert np.array_equal(np.rint(numbers * 255), codes)


def test_other_primaries_become_rec709_as_colour_only() -> None:
    swap = np.array([[0, 1, 0], [1, 0, 0], [0, 0, 1]], np.float64)
    values = texel(1.0, 2.0, 3.0, 0.5, kind=np.float32)

    colour = linearise(values.copy(), "linear", "associated", "colour", swap)
    data = linearise(values.copy(), "linear", "associated", "data", swap)

    assert colour.tolist() == [[[2, 1, 3, 0.5]]]
    assert data.tolist() == values.tolist()
