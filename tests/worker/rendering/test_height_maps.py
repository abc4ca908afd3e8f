"""Reliefs in the light only: Blinn's formula and the exact one (T12)."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Pixels, Studio
from tests.worker.rendering.test_bump_maps import seen_normals, unit

pytestmark = pytest.mark.gl

SIDE = 260  # so that 1/8 is in the middle of a texel
WAVES = {"filter": "bilinear"}


def tile(side: int = SIDE) -> tuple[np.ndarray, np.ndarray]:
    centres = (np.arange(side) + 0.5) / side
    return np.meshgrid(centres, centres[::-1])


def sine() -> np.ndarray:
    u, v = tile()
    return np.sin(2 * np.pi * u) * np.sin(2 * np.pi * v)


def raised(studio: Studio, heights: Any, **how: Any) -> dict[str, Any]:
    return {"height": {"texture": studio.texture(heights), **how}}


def read_at(u: float, v: float) -> dict[str, Any]:
    """Let the pixel in the middle of the plane, where u = v = 1/2, read another place."""
    return {"offset": [u - 0.5, v - 0.5]}


@pytest.mark.parametrize("method", ["blinn", "exact"])
def test_the_sine_of_the_reference_tilts_as_it_says(studio: Studio, method: str) -> None:
    # On a plane of side 1, u and v are lengths. An odd picture has a pixel right in the middle.
    plane = {"type": "plane", "width": 1.0, "height": 1.0}
    surface = raised(
        studio, sine(), depth=0.05, method=method, transform=read_at(1 / 8, 1 / 8), **WAVES
    )

    seen = seen_normals(studio, surface, (9, 9), mesh=plane)[4, 4]

    # Differences over two texels find the slopes (2 pi / 260)^2 / 6 = 1e-4 too small.
    np.testing.assert_allclose(seen, [-0.153341640, -0.153341640, 0.976203200], atol=2e-5)


@pytest.mark.parametrize("width", [1.0, 4.0])
@pytest.mark.parametrize("scale", [1.0, 3.0])
def test_a_slope_is_height_over_length_on_the_shape(
    studio: Studio, width: float, scale: float
) -> None:
    # A plane `width` wide: the same picture rises over a longer way; larger nodes change nothing.
    plane = {"type": "plane", "width": width, "height": 1.0}
    surface = raised(studio, tile()[0], depth=0.25, wrap=["clamp", "clamp"], **WAVES)

    seen = seen_normals(
        studio, surface, (9, 9), mesh=plane, transform={"scale": [scale, scale, scale]}
    )[4, 4]

    np.testing.assert_allclose(seen, unit([-0.25 / width, 0, 1]), atol=1e-5)


def test_a_stretched_node_stretches_its_relief(studio: Studio) -> None:
    plane = {"type": "plane", "width": 1.0, "height": 1.0}
    surface = raised(studio, tile()[0], depth=0.25, wrap=["clamp", "clamp"], **WAVES)

    seen = seen_normals(studio, surface, (9, 9), mesh=plane, transform={"scale": [2.0, 1.0, 5.0]})[
        4, 4
    ]

    np.testing.assert_allclose(seen, unit([-0.25 * 5 / 2, 0, 1]), atol=1e-5)


@pytest.mark.parametrize("method", ["blinn", "exact"])
@pytest.mark.parametrize("value", [0.0, 1.0, -3.0])
def test_a_constant_height_changes_nothing(studio: Studio, method: str, value: float) -> None:
    ball = {"type": "sphere"}
    surface = raised(studio, np.full((4, 4), value), depth=0.1, method=method)

    seen = seen_normals(studio, surface, (32, 32), mesh=ball)

    np.testing.assert_allclose(seen, seen_normals(studio, {}, (32, 32), mesh=ball), atol=2e-6)


def on_a_ball(studio: Studio, method: str, middle: float) -> Pixels:
    """The normal in the middle of a fine unit ball under a relief that rises with u, h = .2 u."""
    ball = {"type": "sphere", "segments": 1024, "rings": 512}
    heights = np.broadcast_to(tile()[0], (SIDE, SIDE))
    how = {"wrap": ["clamp", "clamp"], "method": method, "depth": 0.2, "middle": middle}
    # The place that faces +z has u = 3/4 on a globe.
    return seen_normals(studio, raised(studio, heights, **how, **WAVES), (65, 65), mesh=ball)[
        32, 32
    ]


@pytest.mark.parametrize(
    ("method", "middle", "radius"),
    [("blinn", 0.0, 1.0), ("exact", 0.75, 1.0), ("exact", 0.0, 1.15)],
)
def test_what_stands_out_of_a_ball_slopes_as_on_a_larger_ball(
    studio: Studio, method: str, middle: float, radius: float
) -> None:
    seen = on_a_ball(studio, method, middle)

    # h_u = .2 over 2 pi r of the equator. Blinn leaves the height's own share out: r = 1; where the
    # relief stands .2 (3/4 - middle) high, the exact surface has that much larger a radius.
    slope = seen[0] / seen[2]
    assert slope == pytest.approx(-0.2 / (2 * np.pi * radius), rel=2e-3)


def test_a_dent_is_a_bump_upside_down(studio: Studio) -> None:
    bumps = seen_normals(studio, raised(studio, sine(), depth=0.05), (16, 16))
    dents = seen_normals(studio, raised(studio, sine(), depth=-0.05), (16, 16))

    np.testing.assert_allclose(bumps[..., :2], -dents[..., :2], atol=1e-6)


def test_in_mirrored_copies_slopes_are_mirrored(studio: Studio) -> None:
    ramp = tile()[0]
    how = {"wrap": ["mirror", "clamp"], "depth": 0.5, "transform": {"scale": [2.0, 1.0]}}

    seen = seen_normals(studio, raised(studio, ramp, **how, **WAVES), (16, 16))

    # Two tiles on a plane 2 wide: up to the right on the left half, down on the right one.
    np.testing.assert_allclose(seen[4, 3], unit([-0.5, 0, 1]), atol=1e-5)
    np.testing.assert_allclose(seen[4, 12], unit([0.5, 0, 1]), atol=1e-5)


def test_tilts_of_bumps_and_heights_add_up(studio: Studio) -> None:
    plane = {"type": "plane", "width": 1.0, "height": 1.0}
    tilt = {"texture": studio.texture(np.float32([[[0.1, 0.2]]])), "encoding": "float"}
    how = {"depth": 0.25, "wrap": ["clamp", "clamp"], **WAVES}

    seen = seen_normals(
        studio, {"bump": tilt} | raised(studio, tile()[0], **how), (9, 9), mesh=plane
    )[4, 4]

    np.testing.assert_allclose(seen, unit([0.1 - 0.25, 0.2, 1]), atol=1e-5)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e38])
def test_holes_and_cliffs_still_give_unit_normals(studio: Studio, bad: float) -> None:
    heights = np.zeros((4, 4))
    heights[1, 2] = bad

    seen = seen_normals(studio, raised(studio, heights, depth=1e6), (16, 16))

    np.testing.assert_allclose(np.linalg.norm(seen, axis=2), 1, atol=1e-5)
