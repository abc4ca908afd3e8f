"""What the dish of Gray and Scott may be asked besides its numbers: maps, rims, starts, an end."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.images.image import Image
from worker.synthesis import outcome
from worker.synthesis.gray_scott import initial_dish, react, run

ASSET = {"technique": "image", "asset": "0" * 64}


def spec(**fields):
    body = {"technique": "gray_scott", "size": [48, 40], "steps": 60, **fields}
    return TypeAdapter(Texture).validate_python(body)


def constant(value, low, high):
    return {"texture": {"technique": "constant", "value": value}, "range": [low, high]}


def made(described, picture=None):
    width, height = described.size
    return outcome(described, (width, height), lambda spec, meaning: Image(picture, meaning))


def simple(u, v, feed, kill, spread_u, spread_v, steps, border):
    """The scheme of the module's docstring in numpy, in float32 and the same order."""
    f = np.float32
    feed, loss = f(feed), f(feed + kill)
    for _ in range(steps):
        around = []
        for chemical, rest in ((u, 1), (v, 0)):
            mode = {"torus": "wrap", "no_flux": "edge", "fixed": "constant"}[border]
            more = {"constant_values": rest} if border == "fixed" else {}
            p = np.pad(chemical, 1, mode=mode, **more)
            sum_of_four = p[:-2, 1:-1] + p[2:, 1:-1] + p[1:-1, :-2] + p[1:-1, 2:]
            around.append(sum_of_four - f(4) * chemical)
        after = (u + f(spread_u) * around[0] + feed) / (f(1) + feed + v * v)
        v = v + f(spread_v) * around[1] + after * (v * v) - loss * v
        u, v = after, np.where(v > f(1e-15), v, f(0))
    return u, v


@pytest.mark.parametrize("border", ["torus", "no_flux", "fixed"])
@pytest.mark.parametrize("size", [[48, 40], [17, 300]])
def test_steps_taken_together_are_the_steps_taken_one_by_one(border, size):
    # 300 rows are three blocks, 61 steps are seven passes of eight and one of five
    described = spec(border=border, size=size, steps=61)
    dish = initial_dish(described)

    u, v = react(*dish, described)

    expected = simple(*dish, 0.037, 0.06, 0.2097152, 0.1048576, 61, border)
    assert u.tobytes() == expected[0].tobytes()
    assert v.tobytes() == expected[1].tobytes()


def test_maps_of_one_value_are_those_numbers():
    numbers = made(spec(feed=0.04, kill=0.06))
    maps = made(spec(feed=constant(0.5, 0.03, 0.05), kill=constant(1.0, 0.0, 0.06)))

    assert maps.image.pixels == pytest.approx(numbers.image.pixels, abs=1e-5)
    assert maps.layers["u"].pixels == pytest.approx(numbers.layers["u"].pixels, abs=1e-5)


def test_one_dish_may_live_on_one_side_and_die_on_the_other():
    columns = np.repeat(np.float32([0, 1]), 24)[np.newaxis, :, np.newaxis].repeat(40, axis=0)
    kill = {"texture": ASSET, "range": [0.06, 0.1]}

    v = made(spec(kill=kill, steps=3000, border="no_flux"), columns).image.pixels[..., 0]

    assert v[:, :16].max() > 0.2
    assert v[:, 40:].max() < 1e-3


def test_maps_are_read_cell_by_cell_whatever_the_picture_measures():
    kill = {"texture": {"technique": "perlin", "frequency": 4}, "range": [0.055, 0.065]}
    described = spec(kill=kill, steps=400)

    large = outcome(described, (96, 80), None).image.pixels
    same = outcome(described, (48, 40), None).image.pixels

    # Twice as large the picture blends neighbours: quarters of the way from cell to cell
    middle = (large[::2, ::2] + large[1::2, ::2] + large[::2, 1::2] + large[1::2, 1::2]) / 4
    assert np.corrcoef(middle.ravel(), same.ravel())[0, 1] > 0.99


def test_a_mask_is_where_v_is_at_first_and_a_start_is_the_dish_itself():
    share = np.zeros((40, 48, 1), np.float32)
    share[10:20, 5:30] = 0.5
    masked = made(spec(steps=0, mask=ASSET), share).layers
    both = np.random.default_rng(0).random((40, 48, 2)).astype(np.float32)
    started = made(spec(steps=0, start=ASSET), both).layers

    inside = share[..., 0] > 0
    # u = 1 - .5 / 2 and v = .5 / 4, each disturbed by one in a hundred
    assert masked["u"].pixels[inside] == pytest.approx(0.75, rel=0.011)
    assert masked["v"].pixels[inside] == pytest.approx(0.125, rel=0.011)
    assert (masked["u"].pixels[~inside] == 1).all()
    assert (masked["v"].pixels[~inside] == 0).all()
    assert started["u"].pixels[..., 0].tobytes() == both[..., 0].tobytes()
    assert started["v"].pixels[..., 0].tobytes() == both[..., 1].tobytes()


def test_half_of_the_steps_and_then_the_other_half_are_all_of_them():
    whole = made(spec(steps=400)).layers
    half = made(spec(steps=200)).layers
    state = np.concatenate([half["u"].pixels, half["v"].pixels], axis=2)

    rest = made(spec(steps=200, start=ASSET), state).layers

    assert rest["v"].pixels.tobytes() == whole["v"].pixels.tobytes()


def test_it_stops_when_all_is_gone():
    told = made(spec(kill=0.1, steps=20000, still_below=1e-7)).report

    assert told["still"]
    assert 64 < told["steps"] < 20000
    assert told["chemicals"]["v"]["greatest"] == 0


def test_a_wall_keeps_every_molecule_and_a_fixed_rim_does_not():
    reports = {
        border: made(spec(feed=0.0, kill=0.0, border=border, steps=500)).report["chemicals"]
        for border in ("torus", "no_flux", "fixed")
    }
    dish = initial_dish(spec(feed=0.0))
    mean = float(sum(chemical.mean(dtype=np.float64) for chemical in dish))

    sums = {name: told["u"]["mean"] + told["v"]["mean"] for name, told in reports.items()}
    # A step rounds by at most 2^-24, all to one side at the worst
    assert sums["torus"] == pytest.approx(mean, rel=500 * 2**-24)
    assert sums["no_flux"] == pytest.approx(mean, rel=500 * 2**-24)
    assert abs(sums["fixed"] - mean) > 1e-3


@pytest.mark.parametrize("border", ["torus", "fixed"])
def test_maps_give_the_same_pixels_for_any_number_of_threads(with_threads, border):
    described = spec(size=[32, 300], border=border)
    dish = initial_dish(described)
    feeds = np.full((300, 34), 0.04, np.float32)
    rates = (feeds, feeds + np.float32(0.06), *np.full((2, 1, 34), 0.1, np.float32))

    one = with_threads(1, lambda: run(described, *dish, rates)[0].tobytes())
    two = with_threads(2, lambda: run(described, *dish, rates)[0].tobytes())

    assert one == two
