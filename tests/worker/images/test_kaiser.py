"""T41: a pyramid through a Kaiser window."""

import numpy as np
import pytest

from api_schemas.families import Wrap
from worker.images.kaiser import kaiser_chain
from worker.images.pyramids import mip_chain


def wave(cycles_per_texel: float) -> np.ndarray:
    phase = 2 * np.pi * cycles_per_texel * (np.arange(256) + 0.5)
    return np.exp(1j * phase)


def kept(chain, cycles_per_texel: float) -> float:
    """How much of a wave the next level keeps."""
    parts = np.stack([wave(cycles_per_texel).real, wave(cycles_per_texel).imag], axis=1)
    level = chain(np.tile(parts.astype(np.float32), (2, 1, 1)))[1][0]
    return float(np.abs(level[:, 0] + 1j * level[:, 1]).mean())


def test_waves_it_can_hold_are_kept_and_others_are_not() -> None:
    # A box keeps cos(pi f) of f cycles per texel; the next level holds up to 1/4.
    def through_window(pixels):
        return kaiser_chain(pixels, ("repeat", "repeat"))

    for cycles in (1 / 16, 1 / 8, 3 / 8):
        assert kept(mip_chain, cycles) == pytest.approx(np.cos(np.pi * cycles), abs=1e-6)
    assert kept(through_window, 1 / 16) > 0.99
    assert kept(through_window, 1 / 8) > 0.98
    assert kept(through_window, 3 / 8) < 0.02


@pytest.mark.parametrize("wrap", ["repeat", "mirror"])
def test_each_level_of_even_sides_keeps_the_mean(wrap: Wrap) -> None:
    pixels = np.random.default_rng(1).random((64, 256, 3)).astype(np.float32)
    mean = pixels.mean((0, 1), dtype=np.float64)

    for level in kaiser_chain(pixels, (wrap, wrap)):
        np.testing.assert_allclose(level.mean((0, 1), dtype=np.float64), mean, rtol=1e-6)


@pytest.mark.parametrize("wrap", ["repeat", "mirror", "clamp", "border"])
@pytest.mark.parametrize("size", [(1, 1), (1, 7), (5, 3), (64, 48)])
def test_levels_have_the_sizes_opengl_wants_and_a_constant_stays(
    wrap: Wrap, size: tuple[int, int]
) -> None:
    pixels = np.full((*size, 2), 0.3, np.float32)

    levels = kaiser_chain(pixels, (wrap, wrap))

    assert [level.shape for level in levels] == [level.shape for level in mip_chain(pixels)]
    for level in levels:
        np.testing.assert_array_equal(level, np.float32(0.3))


def test_turning_a_picture_turns_its_levels() -> None:
    pixels = np.random.default_rng(2).random((12, 20, 1)).astype(np.float32)

    upright = kaiser_chain(pixels, ("repeat", "clamp"))
    lying = kaiser_chain(np.ascontiguousarray(pixels.transpose(1, 0, 2)), ("clamp", "repeat"))

    for a, b in zip(upright, lying, strict=True):
        np.testing.assert_allclose(a, b.transpose(1, 0, 2), atol=1e-6)
