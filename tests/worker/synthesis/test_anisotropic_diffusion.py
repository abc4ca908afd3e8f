"""T51: a drop that spreads has the covariance 2 t D, and nothing of it is lost."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.images.image import Image
from worker.synthesis import outcome
from worker.synthesis._directions import directions_of
from worker.synthesis._dish import parameter_rows
from worker.synthesis.anisotropic_diffusion import run, tensors_of

ASSET = {"technique": "image", "asset": "0" * 64}


def spec(**fields):
    body = {"technique": "anisotropic_diffusion", "input": ASSET, "size": [128, 128], **fields}
    return TypeAdapter(Texture).validate_python(body)


def spread(described, start, angles=None):
    rows = parameter_rows(described, {})
    if angles is not None:
        rows["direction"] = np.pad(angles, ((0, 0), (1, 1)))
    return run(described, start[np.newaxis], tensors_of(described, rows), rows)[0][0]


def drop(side=128):
    start = np.zeros((side, side))
    start[side // 2, side // 2] = 1
    return start


@pytest.mark.parametrize("direction", [0.0, 0.4, np.pi / 4, 2.0])
def test_t51_a_drop_has_the_covariance_2_t_d(direction):
    described = spec(along=0.2, across=0.03, direction=direction, steps=100, time_step=0.5)

    after = spread(described, drop())

    u = np.arange(128.0) - 64
    v = -u
    measured = [
        (after.sum(0) * u * u).sum(),
        (after.sum(1) * v * v).sum(),
        (after * np.multiply.outer(v, u)).sum(),
    ]
    cosine, sine = np.cos(direction), np.sin(direction)
    tensor = [
        0.2 * cosine**2 + 0.03 * sine**2,
        0.2 * sine**2 + 0.03 * cosine**2,
        (0.2 - 0.03) * cosine * sine,
    ]
    assert after.sum() == pytest.approx(1, abs=1e-12)
    assert measured == pytest.approx([2 * 50 * entry for entry in tensor], abs=1e-6)


def test_t51_one_step_is_the_mask_of_kass_and_witkin():
    described = spec(along=0.2, across=0.05, direction=0.6, steps=1)

    after = spread(described, drop())[63:66, 63:66]

    d11 = 0.2 * np.cos(0.6) ** 2 + 0.05 * np.sin(0.6) ** 2
    d22, d12 = 0.25 - d11, 0.15 * np.cos(0.6) * np.sin(0.6)
    # Rows run south here: NE and SW gain D12 / 2, NW and SE lose it
    expected = [
        [-d12 / 2, d22, d12 / 2],
        [d11, 1 - 2 * (d11 + d22), d11],
        [d12 / 2, d22, -d12 / 2],
    ]
    assert after == pytest.approx(np.array(expected), abs=1e-14)


@pytest.mark.parametrize("border", ["torus", "no_flux"])
def test_t51_whatever_the_directions_no_mass_is_lost_and_nothing_grows(border):
    random = np.random.default_rng(0)
    start, angles = random.random((48, 48)), random.uniform(0, np.pi, (48, 48))
    # As long as a step may be: 2 / (8 x .25)
    described = spec(size=[48, 48], border=border, along=0.25, across=0.0, steps=400)

    after = spread(described, start, angles)

    assert list(described.refusals()) == []
    assert after.sum() == pytest.approx(start.sum(), rel=1e-12)
    assert (after**2).sum() < (start**2).sum()


def test_t51_it_fades_by_exp_minus_b_t():
    described = spec(size=[16, 16], dissipation=0.01, time_step=0.01, steps=1000)

    after = spread(described, np.ones((16, 16)))

    # (1 - b h)^n = exp(-b t) (1 - b^2 h t / 2 ...): 5e-6 of it
    assert after == pytest.approx(np.exp(-0.01 * 10), rel=1e-5)


def test_inflow_and_dissipation_meet_at_their_quotient():
    described = spec(size=[16, 16], dissipation=0.1, inflow=0.05, steps=300)

    assert spread(described, drop(16)) == pytest.approx(0.5, abs=1e-9)


def test_a_step_beyond_the_bound_is_refused_by_its_name():
    (refusal,) = spec(along=0.5, dissipation=1.0, time_step=0.5).refusals()

    assert refusal.code == "time_step_unstable"
    assert refusal.message.endswith(" 0.4")
    assert list(spec(along=0.5, dissipation=1.0, time_step=0.4).refusals()) == []


@pytest.mark.parametrize("cycles", [(3, 0), (0, 2), (2, 3), (-2, 3)])
def test_directions_run_along_the_crests_of_waves(cycles):
    middle = (np.arange(64) + 0.5) / 64
    u, v = np.meshgrid(middle, 1 - middle)

    found = directions_of(np.cos(2 * np.pi * (cycles[0] * u + cycles[1] * v)), 0.2)

    # Central differences see sin(k) for k, which turns oblique waves by a third of k^2 at most
    off = (found - np.arctan2(cycles[1], cycles[0]) - np.pi / 2 + np.pi / 2) % np.pi - np.pi / 2
    assert np.abs(off).max() < 0.03


def test_a_guide_leads_along_its_edges_and_every_channel_spreads(make):
    random = np.random.default_rng(1).random((64, 64, 3)).astype(np.float32)
    columns = np.cos(2 * np.pi * 4 * np.arange(64) / 64)[np.newaxis, :, np.newaxis]
    stripes = np.float32(columns.repeat(64, axis=0))
    guide = {"technique": "image", "asset": "1" * 64}
    described = spec(size=[64, 64], guide=guide, across=0.0, steps=2000)

    made = outcome(
        described,
        (64, 64),
        lambda spec, meaning: Image(random if spec.asset == "0" * 64 else stripes, meaning),
    ).image

    # The stripes run up and down: columns become even, rows keep their differences
    assert made.meaning == "colour"
    assert made.pixels.std(axis=0).max() < 0.03
    assert made.pixels.std(axis=1).min() > 0.03


def test_at_a_fixed_rim_all_runs_out():
    described = spec(size=[16, 16], border="fixed", across=0.2, steps=2000)

    assert np.abs(spread(described, np.ones((16, 16)))).max() < 1e-4
