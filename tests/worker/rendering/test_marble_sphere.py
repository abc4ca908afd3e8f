"""T48 and T49 in one request: a ball of marble, moved by noise, in its own shadow."""

from typing import Any

import numpy as np
import pytest

from tests.examples import examples
from tests.worker.rendering.studio import Pixels, Studio

pytestmark = pytest.mark.gl

SIZE = (100, 80)


def scene() -> dict[str, Any]:
    body: dict[str, Any] = examples()["marble_sphere"][1]["scene"]
    return body


def drawn(studio: Studio, body: dict[str, Any]) -> dict[str, Pixels]:
    return studio.layers(body, ["object_id", "albedo", "position"], SIZE)


def test_the_ball_is_moved_by_its_noise_and_stays_within_its_bound(studio: Studio) -> None:
    seen = drawn(studio, scene())

    ball = seen["object_id"][..., 0] == 1
    radii = np.linalg.norm(seen["position"][ball], axis=1)
    # The unit range leads from 0 to 1 about the middle: .95 +- .5 / 2
    assert radii.max() <= 1.2
    assert radii.min() >= 0.7 * np.cos(np.pi / 96) ** 2
    assert radii.std() > 0.03


def test_it_keeps_light_from_the_floor(studio: Studio) -> None:
    free = scene()
    del free["lights"][1]["shadow"]

    shaded, lit = drawn(studio, scene()), drawn(studio, free)

    darker = (shaded["picture"][..., :3] < 0.7 * lit["picture"][..., :3]).all(axis=-1)
    assert (shaded["picture"] <= lit["picture"] + 1e-6).all()
    assert 0.02 < darker[seen_of(shaded, 2)].mean() < 0.5


def test_it_is_veined_by_the_ramp_of_the_marble(studio: Studio) -> None:
    seen = drawn(studio, scene())

    albedo = seen["albedo"][seen_of(seen, 1)][:, :3]
    low, middle, high = ([0.03, 0.05, 0.07], [0.42, 0.41, 0.4], [0.9, 0.88, 0.84])
    # Between three colours: each on one of two lines, dark veins and light stone both there
    green = albedo[:, 1]
    for channel in (0, 2):
        at = [stop[1] for stop in (low, middle, high)]
        expected = np.interp(green, at, [stop[channel] for stop in (low, middle, high)])
        # A corner of the ramp within a pixel is a blend
        np.testing.assert_allclose(albedo[:, channel], expected, atol=0.02)
    assert np.quantile(green, 0.02) < 0.25
    assert np.quantile(green, 0.9) > 0.8


def seen_of(seen: dict[str, Pixels], thing: int) -> Any:
    return seen["object_id"][..., 0] == thing
