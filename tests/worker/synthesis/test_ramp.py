import numpy as np
import pytest

from api_schemas.language import FAMILIES
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis.ramp import synthesize

RampSpec = FAMILIES["textures"]["ramp"]
RED, GREEN, BLUE = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
CONSTANT = {"technique": "constant", "value": 0.0}


def colours(values, stops, interpolation="linear"):
    spec = RampSpec.model_validate(
        {
            "technique": "ramp",
            "input": CONSTANT,
            "stops": [{"position": position, "color": color} for position, color in stops],
            "interpolation": interpolation,
        }
    )
    scalars = np.float32([values])[..., np.newaxis]
    before = scalars.copy()
    scalars.flags.writeable = False
    image = synthesize(spec, (len(values), 1), {"input": Image(scalars, "data")}, silent)
    assert (scalars == before).all() or np.isnan(before).any()
    assert image.meaning == "colour"
    return image.pixels[0]


def test_stops_are_pure_and_blend_straight_between():
    stops = [(0.0, RED), (1.0, GREEN), (3.0, BLUE)]

    pixels = colours([0.0, 0.25, 1.0, 2.0, 3.0], stops)

    expected = [RED, [0.75, 0.25, 0], GREEN, [0, 0.5, 0.5], BLUE]
    assert (pixels == expected).all()


def test_the_end_colours_go_on_beyond_the_ends():
    pixels = colours([-5.0, -np.inf, 7.0, np.inf], [(0.0, RED), (1.0, GREEN)])

    assert (pixels == [RED, RED, GREEN, GREEN]).all()


def test_stops_may_come_in_any_order():
    values = np.linspace(-0.5, 3.5, 33)
    stops = [(0.0, RED), (1.0, GREEN), (3.0, BLUE)]

    assert (colours(values, stops) == colours(values, stops[::-1])).all()


@pytest.mark.parametrize("interpolation", ["linear", "smooth", "step"])
def test_two_stops_at_one_position_make_a_hard_edge(interpolation):
    below, above = np.nextafter(np.float32(0.5), np.float32([0, 1]))
    stops = [(0.0, RED), (0.5, RED), (0.5, BLUE), (1.0, BLUE)]

    pixels = colours([below, 0.5, above], stops, interpolation)

    assert (pixels == [RED, BLUE, BLUE]).all()


def test_steps_hold_a_colour_until_the_next_stop():
    pixels = colours([-1.0, 0.0, 0.999, 1.0, 9.0], [(0.0, RED), (1.0, GREEN)], "step")

    assert (pixels == [RED, RED, RED, GREEN, GREEN]).all()


def test_smooth_blends_are_cubic():
    s = np.linspace(0, 1, 65)

    pixels = colours(2 + 4 * s, [(2.0, [0.0, 0.0, 10.0]), (6.0, [1.0, 0.0, 10.0])], "smooth")

    assert pixels[:, 0] == pytest.approx(3 * s**2 - 2 * s**3, abs=1e-7)
    assert (pixels[:, 2] == 10).all()


def test_one_stop_is_a_constant_even_for_nan():
    assert (colours([-1.0, np.nan, 2.0], [(0.5, GREEN)]) == GREEN).all()


def test_positions_may_be_as_far_apart_as_numbers_go():
    pixels = colours([0.0, 3e38], [(-3e38, RED), (3e38, BLUE)])

    assert pixels == pytest.approx(np.array([[0.5, 0, 0.5], BLUE]), abs=1e-6)


def test_a_ramp_colours_noise(make):
    noise = {"technique": "perlin", "frequency": 4}
    grey = [{"position": p, "color": [p] * 3} for p in (0.0, 1.0)]

    scalars = make(noise, (64, 48))
    pixels = make({"technique": "ramp", "input": noise, "stops": grey}, (64, 48))

    assert pixels == pytest.approx(np.repeat(scalars, 3, axis=2), abs=1e-7)
