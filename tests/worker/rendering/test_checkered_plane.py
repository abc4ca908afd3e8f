"""T39 and T41: every filter on the plane to the horizon, against the exact picture."""

from typing import Any

import numpy as np
import pytest

from tests.checkered_plane import FILTERS, SIDE, exact_plane, plane_scene, rms, squares
from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl


@pytest.fixture(scope="module")
def exact() -> np.ndarray:
    return exact_plane()


def drawn(studio: Studio, filter_name: str, **more: Any) -> np.ndarray:
    color = {"texture": studio.texture(squares()), "filter": filter_name, **more}
    return studio.draw(plane_scene(color), (SIDE, SIDE))


def test_t39_t41_better_filters_are_nearer_to_the_exact_picture(
    studio: Studio, exact: np.ndarray
) -> None:
    pictures = {name: drawn(studio, name) for name in FILTERS}
    off = {name: rms(picture, exact) for name, picture in pictures.items()}

    assert off["nearest"] > off["bilinear"] > off["trilinear"] > off["ripmap"] > off["ewa"]
    assert off["trilinear"] > off["summed_area"] > off["ewa"] > off["anisotropic"]
    assert off["anisotropic"] <= 0.0105
    for name, picture in pictures.items():
        assert np.isfinite(picture).all(), name
        assert (picture[: SIDE // 2] == 0).all(), name  # the sky
        assert (picture[SIDE // 2 :, :, 3] == 1).all(), name
        # Sums are differences of larger ones.
        assert picture.min() >= -1e-6, name
        assert picture.max() <= 1 + 1e-6, name


@pytest.mark.parametrize("name", [name for name in FILTERS if name not in ("nearest", "bilinear")])
@pytest.mark.parametrize("pyramid", ["box", "kaiser"])
def test_t39_the_horizon_is_grey(studio: Studio, name: str, pyramid: str) -> None:
    picture = drawn(studio, name, pyramid=pyramid)

    # From 400 squares on: a pixel is two squares wide and 800 deep.
    np.testing.assert_allclose(picture[SIDE // 2, :, 0], 0.5, atol=1e-3)
    assert picture[SIDE // 2 : SIDE // 2 + 3, :, 0].mean() == pytest.approx(0.5, abs=1e-3)


def test_t41_a_kaiser_pyramid_is_as_near(studio: Studio, exact: np.ndarray) -> None:
    for name in ("trilinear", "ewa", "anisotropic"):
        boxes, kaiser = (
            rms(drawn(studio, name, pyramid=kind), exact) for kind in ("box", "kaiser")
        )

        assert kaiser == pytest.approx(boxes, rel=0.25)
