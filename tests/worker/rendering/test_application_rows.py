"""T38, rows whose maps stand in the place of a plain number: neutral, and of a known value.

The other rows are tested in modules of their own: shadows, cookies, surface and light maps, glass.
"""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

SUN = {"type": "directional", "direction": [-1.0, 0.0, -1.0], "irradiance": 2.0}
SKY = {"type": "ambient", "radiance": [0.5, 1.0, 0.25]}
PHONG = {"technique": "phong", "specular_weight": 0.7, "exponent": 3.0, "diffuse_weight": 0.0}
ROUGH = {"technique": "metallic_roughness", "metallic": 0.0}
STEPS = np.array([[0.0, 0.25], [0.5, 1.0]])
BLOCKS = np.kron(STEPS, np.ones((16, 16)))


def poster(studio: Studio, surface: dict[str, Any]) -> Any:
    return studio.poster(surface, lights=[SUN, SKY])


def mapped(studio: Studio, values: Any, **how: Any) -> dict[str, Any]:
    return {"texture": studio.texture(values), "filter": "nearest", **how}


@pytest.mark.parametrize(
    ("surface", "parameter", "neutral"),
    [
        (PHONG, "specular_weight", 0.7),
        (PHONG, "exponent", 3.0),
        (PHONG, "ambient_weight", 1.0),
        (ROUGH, "roughness", 1.0),
        (ROUGH, "occlusion", 1.0),
        (PHONG | {"alpha_mode": "mask"}, "opacity", 1.0),
        (PHONG | {"alpha_mode": "blend"}, "opacity", 1.0),
    ],
)
def test_t38_a_neutral_map_changes_nothing(
    studio: Studio, surface: dict[str, Any], parameter: str, neutral: float
) -> None:
    plain = poster(studio, surface)

    neutrally = poster(studio, surface | {parameter: mapped(studio, [[neutral]])})

    np.testing.assert_allclose(neutrally, plain, rtol=2e-6, atol=1e-7)


def test_t38_a_gloss_map_weights_the_highlight(studio: Studio) -> None:
    """ks (r.v)^n L with r.v = cos 45 degrees: .7 x 2 x 2^(-n/2), over the sky's own part."""
    base = PHONG | {"ambient_weight": 0.0}
    weights = poster(studio, base | {"specular_weight": mapped(studio, STEPS)})
    exponents = poster(studio, base | {"exponent": mapped(studio, STEPS, scale=8.0)})

    np.testing.assert_allclose(weights[..., 0], BLOCKS * 2 * 2**-1.5, rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(exponents[..., 0], 1.4 * 2 ** (-4 * BLOCKS), rtol=1e-5)


def test_t38_an_occlusion_map_dims_the_sky_alone(studio: Studio) -> None:
    """L = k L_sky + L_lamp: between 0 and 1 it is linear in the map."""
    open_, shut = (poster(studio, ROUGH | {"occlusion": k})[0, 0, :3] for k in (1.0, 0.0))

    drawn = poster(studio, ROUGH | {"occlusion": mapped(studio, STEPS)})[..., :3]
    phong = poster(studio, PHONG | {"ambient_weight": mapped(studio, STEPS)})[..., :3]

    np.testing.assert_allclose(drawn, shut + BLOCKS[..., None] * (open_ - shut), rtol=1e-5)
    sky = 0.8 * np.array(SKY["radiance"])
    np.testing.assert_allclose(phong - 1.4 * 2**-1.5, BLOCKS[..., None] * sky, atol=1e-5)


@pytest.mark.parametrize("mode", ["mask", "blend"])
def test_t38_an_opacity_map_cuts_or_thins(studio: Studio, mode: str) -> None:
    surface = {"technique": "unlit", "color": [2.0, 1.0, 0.5], "alpha_mode": mode}
    drawn = poster(studio, surface | {"opacity": mapped(studio, STEPS)})

    alpha = (BLOCKS >= 0.5) if mode == "mask" else BLOCKS
    np.testing.assert_allclose(drawn, alpha[..., None] * [2.0, 1.0, 0.5, 1.0], atol=1e-6)
