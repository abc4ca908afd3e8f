import numpy as np
import pytest

from worker.images.colour import (
    REC709_CHROMATICITIES,
    linear_from_srgb,
    luminance,
    premultiply,
    rec709_from,
    srgb_from_linear,
    unpremultiply,
)

SRGB_OF_18_PERCENT_GREY = 1.055 * 0.18 ** (1 / 2.4) - 0.055  # IEC 61966-2-1


@pytest.mark.parametrize(
    ("linear", "encoded"),
    [
        (0.0, 0.0),
        (1.0, 1.0),
        (0.001, 0.01292),
        (0.18, SRGB_OF_18_PERCENT_GREY),
        (0.5, 0.7353569830524495),
        (4.0, 1.055 * 4.0 ** (1 / 2.4) - 0.055),
        (-0.5, -0.7353569830524495),
    ],
)
def test_the_srgb_curve_has_its_published_values(linear: float, encoded: float) -> None:
    there = srgb_from_linear(np.array([linear], np.float32))
    back = linear_from_srgb(np.array([encoded], np.float32))

    assert there.dtype == back.dtype == np.float32
    assert there[0] == pytest.approx(encoded, rel=1e-7)  # one rounding of float32 is 6e-8
    assert back[0] == pytest.approx(linear, rel=3e-7)  # the argument's rounding, 2.4 times


def test_the_curve_and_its_inverse_undo_each_other() -> None:
    linear = np.linspace(-2, 8, 10001)

    assert np.abs(linear_from_srgb(srgb_from_linear(linear)) - linear).max() < 5e-8  # the break


def test_white_has_luminance_one_and_green_the_most() -> None:
    colours = np.array([[1, 1, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)

    assert luminance(colours) == pytest.approx([1, 0.2126, 0.7152, 0.0722], rel=1e-6)


def test_alpha_multiplies_colour_and_never_itself() -> None:
    straight = np.array([[[0.5, 1.0, 4.0, 0.25]]], np.float32)

    assert premultiply(straight).tolist() == [[[0.125, 0.25, 1.0, 0.25]]]
    assert unpremultiply(premultiply(straight)).tolist() == straight.tolist()


def test_no_coverage_has_no_colour() -> None:
    hidden = np.array([[[0.5, np.inf, np.nan, 0.0], [2.0, 3.0, 4.0, 1.0]]], np.float32)

    assert unpremultiply(hidden).tolist() == [[[0, 0, 0, 0], [2, 3, 4, 1]]]


def test_rec709_is_its_own_rec709() -> None:
    assert rec709_from(REC709_CHROMATICITIES) == pytest.approx(np.eye(3), abs=1e-12)


def test_xyz_becomes_rec709_by_the_published_matrix() -> None:
    # IEC 61966-2-1, equation F.8: XYZ to linear sRGB, rounded to four digits there.
    published = [
        [3.2406, -1.5372, -0.4986],
        [-0.9689, 1.8758, 0.0415],
        [0.0557, -0.2040, 1.0570],
    ]

    matrix = rec709_from((1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1 / 3, 1 / 3))

    assert matrix == pytest.approx(np.array(published), abs=5e-4)


@pytest.mark.parametrize(
    "nonsense",
    [
        (0.0,) * 8,
        (0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3),
        (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3, 0.0),
        (np.nan, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329),
    ],
)
def test_primaries_that_span_nothing_are_refused(nonsense: tuple[float, ...]) -> None:
    with pytest.raises(ValueError, match="chromaticities"):
        rec709_from(nonsense)
