import numpy as np
import pytest

from api_schemas.output import ToneCurve
from worker.images.tone_curves import apply_tone_curve, expose


def pixel(*channels: float) -> np.ndarray:
    return np.array([[channels]], np.float32)


def test_one_stop_doubles_the_light() -> None:
    assert expose(pixel(0.25, 1, 4), 1).tolist() == [[[0.5, 2, 8]]]
    assert expose(pixel(0.25, 1, 4), -2).tolist() == [[[0.0625, 0.25, 1]]]


def test_no_curve_leaves_every_number_alone() -> None:
    colour = pixel(-1, 4, np.inf)

    assert apply_tone_curve(colour, "none").tolist() == colour.tolist()


@pytest.mark.parametrize(("light", "shown"), [(0, 0), (1, 1 / 2), (3, 3 / 4), (99, 0.99)])
def test_reinhard_shows_grey_light_l_as_l_over_one_plus_l(light: float, shown: float) -> None:
    assert apply_tone_curve(pixel(light), "reinhard")[0, 0, 0] == pytest.approx(shown, rel=1e-6)
    assert apply_tone_curve(pixel(light, light, light), "reinhard") == pytest.approx(
        pixel(shown, shown, shown), rel=1e-6
    )


def test_reinhard_keeps_the_ratios_of_a_colour() -> None:
    shown = apply_tone_curve(pixel(4, 2, 1), "reinhard")[0, 0]

    assert shown / shown[2] == pytest.approx([4, 2, 1], rel=1e-6)


@pytest.mark.parametrize(
    ("light", "shown"),
    [(0, 0), (0.18, 0.2669), (1, 2.54 / 3.16), (1e4, 1)],  # x(2.51x+.03)/(x(2.43x+.59)+.14)
)
def test_aces_has_the_values_of_its_formula(light: float, shown: float) -> None:
    assert apply_tone_curve(pixel(light), "aces")[0, 0, 0] == pytest.approx(shown, abs=5e-5)


@pytest.mark.parametrize("curve", ["reinhard", "aces"])
def test_no_light_turns_into_nan(curve: ToneCurve) -> None:
    shown = apply_tone_curve(pixel(np.nan, np.inf, -np.inf), curve)

    assert np.isfinite(shown).all()
    assert shown[0, 0, 2] == 0
