"""Gardner's product of sums (T44) against the sums written down, its range and its period."""

import numpy as np
import pytest

from api_schemas.textures.gardner_product import GardnerProductSpec
from worker.stages import silent
from worker.synthesis._counter_hash import uniforms
from worker.synthesis.gardner_product import synthesize, synthesize_volume


def spec(**fields):
    return GardnerProductSpec(technique="gardner_product", **fields)


def factor(place, other, phase, frequency, count, gain, contrast):
    total, whole = 0.0, 0.0
    for i in range(count):
        swings, strength = 2 * np.pi * frequency * 2**i, gain**i
        total = total + strength * np.sin(swings * place + phase)
        phase = np.pi / 2 * np.sin(swings * other)
        whole += strength
    return (1 + contrast * total / whole) / (1 + contrast)


def test_t44_the_product_is_gardners():
    fields = {"frequency": 2, "count": 3, "gain": 0.707, "contrast": 0.8}
    phases = 2 * np.pi * uniforms(6, 0, 3)
    u, v = (np.arange(512) + 0.5) / 512, 1 - (np.arange(400)[:, np.newaxis] + 0.5) / 400

    pixels = synthesize(spec(**fields, seed=6), (512, 400), {}, silent).pixels[..., 0]

    expected = factor(u, v, phases[0], **fields) * factor(v, u, phases[1], **fields)
    # What a sinc of 8 swings in 400 pixels takes away, (pi 8 / 400)^2 / 6, of either sum
    assert pixels == pytest.approx(expected, abs=2 * 6.6e-4)


def test_values_lie_between_what_the_contrast_leaves_and_one():
    pixels = synthesize(spec(contrast=0.5, count=8), (300, 300), {}, silent).pixels

    assert pixels.min() >= (0.5 / 1.5) ** 2 - 1e-6
    assert pixels.max() <= 1
    assert pixels.std() > 0.03


def test_without_contrast_it_is_flat():
    assert (synthesize(spec(contrast=0.0), (8, 8), {}, silent).pixels == 1).all()


def test_a_solid_repeats_along_every_axis():
    cube = synthesize_volume(spec(frequency=1, count=2), (40, 40, 40), {}, silent).voxels[..., 0]

    for axis in range(3):
        seam = abs(np.take(cube, 0, axis) - np.take(cube, -1, axis)).max()
        assert seam <= 1.3 * abs(np.diff(cube, axis=axis)).max()


def test_the_third_axis_of_a_solid_is_another_factor():
    voxels = synthesize_volume(spec(count=2, seed=1), (8, 8, 8), {}, silent).voxels[..., 0]

    ratio = voxels / voxels[:1]

    # Along w the first two factors stay, and the third follows u only
    assert ratio == pytest.approx(np.broadcast_to(ratio[:, :1], ratio.shape), rel=1e-5)
