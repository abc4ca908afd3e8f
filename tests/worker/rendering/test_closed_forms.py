"""Textures evaluated at the fragment against the same at points on the CPU: within 1e-5."""

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from api_schemas.families import TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from worker import synthesis
from worker.closed_form import ClosedForm
from worker.rendering.chunks import SHADERS
from worker.synthesis import checkerboard, gardner, marble, perlin, ramp, wood, worley
from worker.synthesis._perlin_sums import KINDS

TOLERANCE = 1e-5
COUNT = 4096
PIXEL = np.array([[1, 0, 0], [0, 1, 0]]) / 512
"""Steps to a pixel's neighbours, in tiles."""
LEANING = np.array([[1, 0.25, -0.5], [0, 1, 0.25]]) / 512
STOPS = [
    {"position": 0.2, "color": [1.0, 0.0, 0.25]},
    {"position": 0.45, "color": [0.0, 2.0, 0.5]},
    {"position": 0.6, "color": [0.1, 0.2, 0.3]},
]


def spec(body):
    return TypeAdapter(Texture).validate_python(body)


def places(axes):
    """Points in and around the tile, as float32 holds them, with some on its edges."""
    found = np.random.default_rng(5).uniform(-2, 3, (COUNT, 3)).astype(np.float32)
    found[:8] = np.indices((2, 2, 2)).reshape(3, 8).T / 2
    found[:, axes:] = 0
    return found


@pytest.fixture
def draw():
    """Evaluate a closed form: draw(form, places (n, 3), reach) -> (n, 4)."""
    # Imported here: it needs OpenGL.
    from tests.worker.rendering.formula_drawing import drawn  # noqa: PLC0415

    return drawn


def perlin_at(texture, where, steps):
    return perlin.noise_at(texture, where, 1 / np.linalg.norm(steps, axis=1).max())[0]


def gardner_at(texture, where, steps):
    return gardner.mean_at(texture, where, steps)


def worley_at(texture, where, steps):
    return worley.distances_at(texture, where)


def checkerboard_at(texture, where, steps):
    return checkerboard.color_at(texture, where, abs(steps).sum(axis=0))


AT = {
    "perlin": perlin_at,
    "gardner": gardner_at,
    "worley": worley_at,
    "checkerboard": checkerboard_at,
}
BODIES = [
    {"technique": "gardner", "frequency": 9, "bandwidth": 20, "count": 12, "seed": 2},
    {"technique": "gardner", "waves": [{"cycles": [1000, -3, 40], "phase": 7.5}]},
    {"technique": "checkerboard", "cells": [7, 64, 3]},
    *[{"technique": "worley", "frequency": 5, "metric": m} for m in worley.METRICS],
    *[{"technique": "worley", "frequency": 64, "output": o, "seed": 9} for o in worley.OUTPUTS],
    {"technique": "worley", "frequency": 6, "points": "poisson", "output": "f2", "seed": 2**32 - 1},
    {"technique": "worley", "frequency": 1, "points": "poisson", "seed": 3},
    {"technique": "worley", "frequency": 1, "points": "poisson", "seed": 5},
    {"technique": "worley", "frequency": 3, "jitter": 0.3},
    {"technique": "perlin", "frequency": 8, "range": "signed"},
    {"technique": "perlin", "frequency": 200, "gradients": "reference", "seed": 1},
    {"technique": "perlin", "frequency": 5, "fade": "cubic", "octaves": 4, "depth": 0.3},
    {"technique": "perlin", "frequency": 3, "fade": "linear", "octaves": 3, "time": 0.7},
    {"technique": "perlin", "frequency": 2, "octaves": 16, "lacunarity": 8, "time": -3.1},
    *[
        {"technique": "perlin", "frequency": 6, "octaves": 8, "sum": kind, "range": shown}
        for kind in KINDS
        for shown in ("unit", "signed")
    ],
]


def form_of(body):
    return synthesis.closed_form(spec(body), solid=True)


def name_of(body):
    return "-".join(str(value) for value in body.values() if not isinstance(value, list))


@pytest.mark.gl
@pytest.mark.parametrize("solid", [False, True], ids=["plane", "space"])
@pytest.mark.parametrize("body", BODIES, ids=name_of)
def test_a_fragment_shows_what_the_point_has(draw, body, solid):
    texture, axes = spec(body), 3 if solid else 2
    where, steps = places(axes), LEANING if solid else PIXEL

    shown = draw(synthesis.closed_form(texture, solid=solid), where, steps)

    points = where[:, :axes].astype(np.float64)
    expected = AT[texture.technique](texture, points, steps[:, :axes])
    expected = expected[:, np.newaxis] if expected.ndim == 1 else expected
    assert abs(shown[:, :3] - expected).max() <= TOLERANCE
    assert (shown[:, 3] == 1).all()


@pytest.mark.gl
@pytest.mark.parametrize("name", ["checkerboard", "gardner", "perlin"])
def test_what_a_large_pixel_cannot_show_is_averaged_or_fades(draw, name):
    texture = spec({"technique": name})
    where = places(2)

    shown = draw(synthesis.closed_form(texture, solid=False), where, PIXEL * 51.2)

    expected = AT[name](texture, where[:, :2].astype(np.float64), PIXEL[:, :2] * 51.2)
    expected = expected[:, np.newaxis] if expected.ndim == 1 else expected
    assert abs(shown[:, :3] - expected).max() <= TOLERANCE


@pytest.mark.gl
def test_a_pixel_without_extent_shows_the_point_itself(draw):
    board = spec({"technique": "checkerboard"})
    where = places(2)[8:]  # on an edge it is neither

    shown = draw(synthesis.closed_form(board, solid=False), where, PIXEL * 0)

    expected = checkerboard.color_at(board, where[:, :2].astype(np.float64), [0.0, 0.0])
    assert abs(shown[:, :3] - expected).max() <= TOLERANCE


@pytest.mark.gl
@pytest.mark.parametrize("interpolation", ["linear", "smooth", "step"])
def test_a_ramp_colours_what_is_in_it(draw, interpolation):
    noise = {"technique": "perlin", "frequency": 4, "octaves": 3}
    texture = spec(
        {"technique": "ramp", "input": noise, "stops": STOPS, "interpolation": interpolation}
    )
    where = places(3)

    form = synthesis.closed_form(texture, solid=True)
    shown = draw(form, where, PIXEL)

    # Read off the noise that the fragment shows itself: a flat band's edge is infinitely steep
    value = np.ascontiguousarray(draw(form.inputs["input"], where, PIXEL)[:, :1])
    expected = ramp.colored(texture, value)[:, 0]
    # 1e-7 of a value between stops .15 apart, whose colours are 2 apart
    assert abs(shown[:, :3] - expected).max() <= TOLERANCE


@pytest.mark.gl
@pytest.mark.parametrize("value", [0.25, [0.5, 0.5], [1.0, 2.0, 3.0], [1.0, 0.5, 0.25, 0.5]])
def test_a_constant_is_what_a_sampler_would_read(draw, value):
    texture = spec({"technique": "constant", "value": value})

    shown = draw(synthesis.closed_form(texture, solid=False), places(2), PIXEL)

    grey = [[value] * 3, 1.0] if isinstance(value, float) else None
    hues, alpha = (
        grey
        or {
            2: ([value[0]] * 3, value[-1]),
            3: (value, 1.0),
            4: (value[:3], value[-1]),
        }[len(value)]
    )
    assert (shown == np.array([*(hue * alpha for hue in hues), alpha], np.float32)).all()


def test_every_chunk_has_a_technique_that_can_tell_its_formula():
    chunks = {path.stem for path in (SHADERS / "textures").glob("*.glsl")}

    assert chunks <= set(FAMILIES["textures"])
    assert chunks == {
        name for name in FAMILIES["textures"] if hasattr(synthesis._module(name), "closed_form")
    }


@pytest.mark.gl
@pytest.mark.parametrize("solid", [False, True], ids=["plane", "space"])
@pytest.mark.parametrize("strength", [0.0, 12.0])
def test_marble_is_bent_by_what_is_in_it(draw, solid, strength):
    texture = spec({"technique": "marble", "veins": [3, -2, 5], "strength": strength})
    form = synthesis.closed_form(texture, solid=solid)
    axes, steps = (3, LEANING) if solid else (2, PIXEL)
    where = places(axes)

    shown = draw(form, where, steps)[:, 0]

    bent = draw(form.inputs["turbulence"], where, steps)[:, 0].astype(np.float64)
    points = where[:, :axes].astype(np.float64)
    assert shown == pytest.approx(
        marble.marble_at(texture, points, bent, steps[:, :axes]), abs=TOLERANCE
    )


@pytest.mark.gl
@pytest.mark.parametrize("trunk", ["u", "v", "w"])
def test_wood_is_disturbed_by_what_is_in_it(draw, trunk):
    texture = spec({"technique": "wood", "trunk": trunk, "heart": [0.3, 0.8], "rings": 7.5})
    form = synthesis.closed_form(texture, solid=True)
    where = places(3) % 1
    # Wide pixels, since float32 cannot tell on which side of a ring's hard edge a point lies
    steps = PIXEL * 16

    shown = draw(form, where, steps)[:, 0]

    noise = draw(form.inputs["noise"], where, steps)[:, 0].astype(np.float64)
    expected = wood.wood_at(texture, where.astype(np.float64), noise, 16 / 512)
    # The edge is as steep as 1 over .23 of a ring, up to 10 rings from the heart: 10 * 2^-24 * 4.3
    assert shown == pytest.approx(expected, abs=TOLERANCE)


@pytest.mark.gl
def test_levels_and_mixtures_are_what_the_same_numbers_give(draw):
    noise, other = {"technique": "perlin"}, {"technique": "perlin", "seed": 4}
    where = places(3)
    first, second = (draw(form_of(body), where, PIXEL)[:, 0] for body in (noise, other))

    leveled = {"input_range": [0.3, 0.6], "output_range": [2.0, -1.0], "gamma": 2.2}
    stretched = draw(form_of({"technique": "levels", "input": noise, **leveled}), where, PIXEL)
    mixed = draw(
        form_of({"technique": "mix", "a": noise, "b": other, "amount": 0.25}), where, PIXEL
    )
    masked = draw(
        form_of({"technique": "mix", "a": noise, "b": other, "amount": other}), where, PIXEL
    )

    share = np.clip((first.astype(np.float64) - 0.3) / 0.3, 0, 1) ** (1 / 2.2)
    # A root is steep near 0: of what is below .001 of the range only the order is kept
    usable = (share == 0) | (share > 0.05)
    assert stretched[usable, 0] == pytest.approx((2 - 3 * share)[usable], abs=TOLERANCE)
    assert mixed[:, 0] == pytest.approx(0.75 * first + 0.25 * second, abs=TOLERANCE)
    assert masked[:, 0] == pytest.approx((1 - second) * first + second**2, abs=TOLERANCE)


@pytest.mark.gl
@pytest.mark.parametrize("name", ["clouds", "fire", "granite"])
def test_a_preset_has_the_formula_of_its_composition(draw, name):
    preset = spec({"technique": name})
    where = places(3)

    shown = draw(synthesis.closed_form(preset, solid=True), where, PIXEL)

    composed = draw(synthesis.closed_form(preset.composed(), solid=True), where, PIXEL)
    assert (shown == composed).all()
    assert shown[:, :3].std() > 0.05


@pytest.mark.parametrize("name", sorted(FAMILIES["textures"]))
def test_who_says_to_have_a_formula_has_one(name):
    kind = FAMILIES["textures"][name]
    noise = {"technique": "perlin"}
    body = {"technique": name}
    for field, info in kind.model_fields.items():
        if info.is_required() and field != "technique":
            body[field] = {"value": 0.5, "stops": STOPS, "asset": "0" * 64}.get(field, noise)
    try:
        texture = spec(body)
    except ValidationError:
        assert kind.has_formula is TextureSpec.has_formula  # needs more than a texture
        return

    assert texture.has_formula() == (synthesis.closed_form(texture, solid=False) is not None)


def test_what_has_no_formula_leaves_none_to_what_holds_it():
    slope = {"technique": "perlin", "output": "slope"}
    held = {"technique": "ramp", "input": slope, "stops": STOPS}

    assert synthesis.closed_form(spec(slope), solid=False) is None
    assert synthesis.closed_form(spec(held), solid=False) is None
    assert isinstance(synthesis.closed_form(spec({"technique": "perlin"}), solid=False), ClosedForm)
