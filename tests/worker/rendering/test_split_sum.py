"""Rough mirrors in an environment (X17, T35), against sums over all directions."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from tests.worker.rendering.surroundings import MIRROR, ball, latlong

pytestmark = pytest.mark.gl


@pytest.mark.parametrize("roughness", [0.2, 0.3, 0.5, 0.8, 1.0])
def test_x17_seen_head_on_the_split_sum_is_the_integral(studio: Studio, roughness: float) -> None:
    # D V n.l with n = v = +z over a sky by brute force: a metal of white mirrors
    towards = latlong(512)
    light = 0.2 + 0.8 * (towards @ [0.36, 0.48, 0.8] > 0.6) + 0.3 * towards[..., 0]
    seen = ball(studio, {"texture": studio.texture(light)}, {**MIRROR, "roughness": roughness}, 129)

    alpha = roughness**2
    cosine = np.clip(towards[..., 2], 0, 1)
    facing = (1 + towards[..., 2]) / 2
    lobe = alpha**2 / (np.pi * (facing * (alpha**2 - 1) + 1) ** 2) * 0.5 * cosine
    lobe /= cosine + np.sqrt(cosine**2 * (1 - alpha**2) + alpha**2)
    solid = np.cos(np.pi * (0.5 - (np.arange(256) + 0.5) / 256))[:, None] * 2 * np.pi**2 / 512 / 256
    expected = (lobe * light * solid).sum()
    assert seen[64, 64, 1] == pytest.approx(expected, rel=2.5e-2)
