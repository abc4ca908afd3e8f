"""Opaque, mask and blend: what opacity does to a surface by itself."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.panes import BLUE, CAMERA, RED, glass, poster
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl


RAMP = np.tile((np.arange(64, dtype=np.float32) + 0.5) / 64, (4, 1))
"""Opacity that grows from left to right: AlphaBlendModeTest's idea, one texel a pixel."""


def ramp(studio: Studio, **more: Any) -> np.ndarray:
    mapped = {"texture": studio.texture(RAMP), "filter": "nearest"}
    surface = glass([0.5, 1.0, 2.0], mapped, **more)
    return studio.poster(surface, (64, 4))


def test_opaque_ignores_opacity(studio: Studio) -> None:
    drawn = ramp(studio, alpha_mode="opaque")

    assert (drawn == np.array([0.5, 1.0, 2.0, 1.0])).all()


def test_blend_is_as_opaque_as_the_texel(studio: Studio) -> None:
    drawn = ramp(studio)

    np.testing.assert_allclose(drawn, RAMP[..., None] * [0.5, 1.0, 2.0, 1.0], rtol=1e-6)


@pytest.mark.parametrize("cutoff", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_mask_shows_what_reaches_the_cutoff_as_a_whole(studio: Studio, cutoff: float) -> None:
    drawn = ramp(studio, alpha_mode="mask", alpha_cutoff=cutoff)

    expected = (cutoff <= RAMP)[..., None] * [0.5, 1.0, 2.0, 1.0]
    np.testing.assert_array_equal(drawn, expected)


def test_opacity_at_the_cutoff_is_opaque_as_gltf_says(studio: Studio) -> None:
    surface = {"technique": "unlit", "alpha_mode": "mask", "alpha_cutoff": 0.3, "opacity": 0.3}

    assert (studio.poster(surface) == 1).all()
    assert not studio.poster(surface | {"opacity": 0.2999}).any()


def test_through_a_hole_one_sees_what_is_behind(studio: Studio) -> None:
    holes = np.array([[1.0, 0.0], [0.0, 1.0]])
    mapped = {"texture": studio.texture(holes), "filter": "nearest"}
    nodes = [
        poster(1.0, glass(RED, mapped, alpha_mode="mask")),
        poster(0.0, {"technique": "unlit", "color": BLUE}),
    ]

    drawn = studio.draw({"camera": CAMERA, "nodes": nodes}, (4, 4))

    expected = np.where(np.kron(holes, np.ones((2, 2)))[..., None] > 0, [*RED, 1], [*BLUE, 1])
    np.testing.assert_array_equal(drawn, expected)


@pytest.mark.parametrize("share", [0.15, 0.5, 0.85])
@pytest.mark.parametrize("how", [{}, {"scale": -1.0, "bias": 1.0}])
def test_leaves_keep_their_share_where_they_are_small(
    studio: Studio, share: float, how: dict[str, Any]
) -> None:
    # Leaves of one texel, seen so small that each pixel holds eight by eight of them.
    leaves = np.random.default_rng(5).random((512, 512)) < share
    stored = studio.texture(1.0 - leaves if how else leaves)
    surface = glass([1.0, 1.0, 1.0], {"texture": stored} | how, alpha_mode="mask")

    drawn = studio.poster(surface, (64, 64))

    # Each level has the right share; between two levels, and between texels, what is read is nearer
    # to the mean. Without the care for it the smaller share would be gone altogether.
    assert drawn[..., 3].mean() == pytest.approx(leaves.mean(), abs=0.12)
    assert 0.03 < drawn[..., 3].mean() < 0.97


@pytest.mark.parametrize(
    ("value", "alpha"),
    [(-3.0, 0.0), (0.0, 0.0), (7.0, 1.0), (np.inf, 1.0), (-np.inf, 0.0), (np.nan, 0.0)],
)
def test_any_number_in_a_picture_is_some_opacity(
    studio: Studio, value: float, alpha: float
) -> None:
    mapped = {"texture": studio.texture(np.full((1, 1), value)), "filter": "nearest"}

    blended = studio.poster(glass([1.0, 1.0, 1.0], mapped))
    masked = studio.poster(glass([1.0, 1.0, 1.0], mapped, alpha_mode="mask"))

    assert (blended == alpha).all()
    assert (masked == alpha).all()


@pytest.mark.parametrize("mode", ["opaque", "mask", "blend"])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_a_back_is_not_drawn_where_there_is_one_side_only(
    studio: Studio, mode: str, mirror: float
) -> None:
    surface = glass(RED, 1.0, alpha_mode=mode, double_sided=False)
    transform = {"scale": [mirror, 1.0, 1.0]}

    front = studio.poster(surface, transform=transform)
    back = studio.poster(surface, transform=transform | {"rotation": [0.0, 1.0, 0.0, 0.0]})

    assert (front[..., 3] == 1).all()
    assert not back.any()
