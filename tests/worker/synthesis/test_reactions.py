"""Reactions against linear theory, published states, and what no reaction may break (T50)."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from worker.errors import RenderError
from worker.images.image import Image
from worker.synthesis import outcome
from worker.synthesis._dish import dish_at
from worker.synthesis._reaction import Reaction, run

ASSET = {"technique": "image", "asset": "0" * 64}
SYSTEMS = [
    "brusselator",
    "fitzhugh_nagumo",
    "meinhardt_spots",
    "meinhardt_stripes",
    "schnakenberg",
    "turing",
]


def spec(name, **fields):
    if "irregularity" in FAMILIES["textures"][name].model_fields:
        fields = {"irregularity": 0.0, **fields}
    return TypeAdapter(Texture).validate_python({"technique": name, "size": [64, 64], **fields})


def react(described, cells):
    """Return the cells inside of the rim after all steps from the cells given."""
    reaction = Reaction(described, {})
    reaction.cells[:, 1:-1, 1:-1] = cells
    module = __import__(f"worker.synthesis.{described.technique}", fromlist=["_react"])
    return run(reaction, module._react)[0][:, 1:-1, 1:-1]


def matrix(described):
    """Return the Jacobian at rest and the diffusions: linear theory written anew with numpy."""
    values = described.middle()
    rest = np.array(described.rest(values))
    near = 1e-6
    columns = [
        (
            np.array(described.rates(rest + near * direction, values))
            - described.rates(rest - near * direction, values)
        )
        / (2 * near)
        for direction in np.eye(len(rest))
    ]
    spread = [values[name] if name else 0.0 for name in described.spreading]
    return np.array(columns).T, np.diag(spread), rest


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("turing", [4, 4]),
        ("meinhardt_spots", [4 / 3, 4 / 9]),
        ("meinhardt_stripes", [0.75, 0.75, 0.140625, 0.75, 0.75]),
        ("schnakenberg", [1, 0.9]),
        ("brusselator", [4.5, 5 / 3]),
        ("fitzhugh_nagumo", [0, 0]),
    ],
)
def test_t50_the_published_states_are_at_rest_and_stay(name, expected):
    described = spec(name, steps=3, disturbance=0.0)

    rest = described.rest(described.middle())
    cells = react(described, np.array(rest)[:, np.newaxis, np.newaxis])

    assert rest == pytest.approx(expected, abs=1e-9)
    assert cells == pytest.approx(np.array(expected)[:, np.newaxis, np.newaxis] + 0 * cells)


@pytest.mark.parametrize("name", SYSTEMS)
def test_one_step_is_reaction_and_the_five_point_laplacian(name):
    described = spec(name, steps=1, time_step=0.125)
    values = described.middle()
    rest = np.array(described.rest(values))[:, np.newaxis, np.newaxis]
    start = rest + np.random.default_rng(0).uniform(0.05, 0.5, (len(rest), 64, 64))

    lap = sum(np.roll(start, shift, axis) for shift in (1, -1) for axis in (1, 2)) - 4 * start
    spread = np.array([values[name] if name else 0.0 for name in described.spreading])
    change = np.array(described.rates(start, values)) + spread[:, np.newaxis, np.newaxis] * lap

    assert react(described, start) == pytest.approx(start + 0.125 * change, rel=1e-12)


def test_a13_a_mode_of_turk_grows_as_its_eigenvalue_says():
    described = spec(
        "turing",
        speed=1 / 64,
        diffusion_a=1 / 8,
        diffusion_b=1 / 64,
        steps=200,
        disturbance=0.0,
    )
    mode = np.cos(2 * np.pi * 8 * np.arange(64) / 64)
    start = 4 + 1e-6 * np.array([1, -2.349504632])[:, np.newaxis, np.newaxis] * mode[np.newaxis]
    start = np.broadcast_to(start.reshape(2, 1, 64), (2, 64, 64))

    after = react(described, start)

    grown = np.abs(np.fft.rfft(after[0].mean(0)))[8] / np.abs(np.fft.rfft(start[0].mean(0)))[8]
    assert grown == pytest.approx(9.132786, rel=1e-4)


@pytest.mark.parametrize(
    ("name", "fields", "steps"),
    [
        ("turing", {"speed": 1 / 64, "diffusion_a": 1 / 8, "diffusion_b": 1 / 64}, 900),
        ("schnakenberg", {"speed": 0.0125}, 4000),
        ("brusselator", {"speed": 0.0045}, 5000),
        ("fitzhugh_nagumo", {"speed": 0.01}, 3500),
    ],
)
def test_turing_wavelengths_are_those_of_linear_theory_on_the_lattice(name, fields, steps):
    described = spec(name, size=[128, 128], steps=steps, disturbance=0.0, **fields)
    jacobian, spread, rest = matrix(described)
    noise = np.random.default_rng(3).standard_normal((2, 128, 128))

    after = react(described, rest[:, np.newaxis, np.newaxis] + 1e-9 * noise)[0] - rest[0]

    taken = np.linspace(0.001, 2, 20000)
    stacked = jacobian - taken[:, np.newaxis, np.newaxis] * spread
    growth = np.linalg.eigvals(stacked).real.max(axis=1)
    # On the lattice a wave of k loses 4 sin^2(k / 2)
    predicted = np.pi / np.arcsin(np.sqrt(taken[growth.argmax()]) / 2)
    energy = np.abs(np.fft.fft2(after)) ** 2
    k = 2 * np.pi * np.fft.fftfreq(128)
    lost = np.add.outer(4 * np.sin(k / 2) ** 2, 4 * np.sin(k / 2) ** 2)
    measured = np.pi / np.arcsin(np.sqrt((energy * lost).sum() / energy.sum()) / 2)
    assert growth.max() > 0
    assert 1e-8 < np.abs(after).max() < 0.05  # it has grown, and is still linear
    assert measured == pytest.approx(predicted, rel=0.03)


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("border", ["torus", "no_flux"])
def test_without_reaction_nothing_is_lost(name, border):
    still = {
        "turing": {"speed": 0.0},
        "schnakenberg": {"speed": 0.0},
        "brusselator": {"speed": 0.0},
        "fitzhugh_nagumo": {"speed": 0.0},
        "meinhardt_spots": {"speed": 0.0},
        "meinhardt_stripes": {"decay": 1e-30, "decay_c": 1e-30, "follow": 0.0, "beta": 0.0},
    }[name]
    described = spec(name, steps=50, border=border, **still)
    start = np.random.default_rng(1).uniform(1e-9, 2e-9, (len(described.layers), 64, 64))

    after = react(described, start)

    assert after[0].std() < 0.9 * start[0].std()
    assert after.sum(axis=(1, 2)) == pytest.approx(start.sum(axis=(1, 2)), rel=1e-9)


def test_at_a_fixed_rim_the_dish_stays_at_rest():
    described = spec("schnakenberg", speed=0.0, steps=3000, border="fixed", size=[16, 16])
    start = np.full((2, 16, 16), 3.0)

    after = react(described, start)

    # The slowest wave of 16 cells within a rim fades by 1 - D 8 sin^2(pi / 34) a step
    left = (1 - 0.2 * 8 * np.sin(np.pi / 34) ** 2) ** 3000
    assert np.abs(after[1] - 0.9).max() < 2 * 2.1 * left + 1e-12


def test_a_torus_has_no_edges():
    described = spec("turing", steps=60)
    start = 4 + np.random.default_rng(2).uniform(-1, 1, (2, 64, 64))

    still, moved = react(described, start), react(described, np.roll(start, (9, 30), (1, 2)))

    assert np.roll(still, (9, 30), (1, 2)).tobytes() == moved.tobytes()


def test_a_map_of_one_value_is_that_number_and_a_map_of_two_makes_two_patterns():
    number = outcome(spec("schnakenberg", steps=900, b=0.75), (64, 64), None)
    mapped = {"texture": {"technique": "constant", "value": 0.5}, "range": [0.5, 1.0]}
    even = outcome(spec("schnakenberg", steps=900, b=mapped), (64, 64), None)
    columns = np.repeat(np.float32([0, 1]), 32)[np.newaxis, :, np.newaxis].repeat(64, axis=0)
    halves = {"texture": ASSET, "range": [2.5, 0.9]}

    split = outcome(
        spec("schnakenberg", steps=4000, b=halves, border="no_flux", disturbance=0.1),
        (64, 64),
        lambda spec, meaning: Image(columns, meaning),
    ).layers["u"]

    assert even.image.pixels.tobytes() == number.image.pixels.tobytes()
    # b = 2.5 is beyond the instability (a rest of u = 2.6), b = .9 within
    left, right = split.pixels[:, :16, 0], split.pixels[:, 48:, 0]
    assert left == pytest.approx(2.6, abs=0.05)
    assert right.std() > 0.5


def test_a_picture_and_a_mask_say_what_it_starts_from():
    texels = np.random.default_rng(4).uniform(2, 5, (64, 64, 2)).astype(np.float32)
    half = np.repeat(np.float32([0, 1]), 32)[np.newaxis, :, np.newaxis].repeat(64, axis=0)

    def load(spec, meaning):
        return Image(texels if spec.asset == "0" * 64 else half, meaning)

    body = {"disturbance": 0.5, "start": ASSET, "mask": {"technique": "image", "asset": "1" * 64}}
    made = outcome(spec("turing", steps=0, **body), (64, 64), load)
    bare = outcome(spec("turing", steps=0, start=ASSET), (64, 64), load)

    for index, name in enumerate("ab"):
        given = texels[..., index]
        assert bare.layers[name].pixels[..., 0].tobytes() == given.tobytes()
        off = np.abs(made.layers[name].pixels[..., 0] - given)
        assert not off[:, :32].any()
        # At most half of 4, the state at rest
        assert 1.9 < off[:, 32:].max() <= 2


def test_it_stops_when_nothing_changes_any_more():
    described = spec("schnakenberg", b=2.5, disturbance=0.1, still_below=1e-6, steps=50000)

    made = outcome(described, (64, 64), None)

    assert made.report["still"]
    assert made.report["fastest_change"] < 1e-6
    assert 64 < made.report["steps"] < 50000
    assert made.report["steps"] % 64 == 0
    assert made.report["chemicals"]["u"]["mean"] == pytest.approx(2.6, abs=1e-3)


def test_every_chemical_is_a_layer_and_the_picture_is_one_of_them_stretched():
    made = outcome(spec("meinhardt_stripes", steps=100, irregularity=0.1), (32, 32), None)
    raw = spec("meinhardt_stripes", steps=100, irregularity=0.1, range="raw", chemical="e")

    assert list(made.layers) == ["a", "b", "c", "d", "e"]
    assert (made.image.pixels.min() >= 0, made.image.pixels.max() <= 1) == (True, True)
    shown = outcome(raw, (32, 32), None)
    assert shown.image.pixels.tobytes() == shown.layers["e"].pixels.tobytes()


def test_what_grows_without_end_fails_with_a_reason():
    wild = spec("turing", time_step=4.0, disturbance=0.5, steps=3000)

    with pytest.raises(RenderError) as caught:
        outcome(wild, (64, 64), None)

    assert caught.value.code == "reaction_diverged"


def test_a_dish_at_rest_has_what_the_start_does_not_say():
    described = spec("meinhardt_stripes", start=ASSET)
    picture = Image(np.full((4, 4, 2), 9, np.float32), "data")

    cells = dish_at(described, [1, 2, 3, 4, 5], {"start": picture})

    assert cells[:, 30, 30].tolist() == [9, 9, 3, 4, 5]
    assert cells[:, 0, 30].tolist() == [1, 2, 3, 4, 5]


def elongation(picture):
    """Return the spread of a picture's power up and down over that from side to side."""
    energy = np.abs(np.fft.fft2(picture - picture.mean())) ** 2
    frequencies = np.fft.fftfreq(len(picture))
    return np.sqrt((energy.T @ frequencies**2).sum() / (energy @ frequencies**2).sum())


@pytest.mark.parametrize("direction", [0.0, np.pi / 2])
def test_t51_stripes_fall_into_line_with_the_direction(direction):
    described = spec(
        "schnakenberg", steps=3000, across=0.2, direction=direction, disturbance=0.1, b=0.75
    )

    picture = outcome(described, (64, 64), None).layers["u"].pixels[..., 0].astype(np.float64)

    # Along u waves are long and frequencies low; across it, high
    assert elongation(picture) ** (1 if direction == 0 else -1) > 1.8


def test_t51_a_drop_of_each_chemical_spreads_by_its_own_tensor():
    described = spec("schnakenberg", speed=0.0, steps=100, across=0.25, direction=0.6, range="raw")
    start = np.zeros((2, 64, 64))
    start[:, 32, 32] = 1

    after = react(described, start)

    u = np.arange(64.0) - 32
    for drop, along in zip(after, (0.01, 0.2), strict=True):
        tensor = along * (1 - 0.75 * np.sin(0.6) ** 2)
        assert drop.sum() == pytest.approx(1, abs=1e-12)
        assert (drop.sum(0) * u * u).sum() == pytest.approx(2 * 100 * tensor, abs=1e-6)
