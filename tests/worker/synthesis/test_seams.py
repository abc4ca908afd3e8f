"""T17: the seam of a texture against its closed form."""

from typing import Any

import numpy as np
import pytest

from api_schemas.textures.seams import SeamsSpec
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis.seams import synthesize


def measured(pixels: Any, **more: Any) -> dict[str, Any]:
    array = np.asarray(pixels, np.float32)
    image = Image(array if array.ndim == 3 else array[..., None], "data")
    body = {"technique": "seams", "input": {"technique": "constant", "value": 0.0}, **more}
    spec = SeamsSpec.model_validate(body)
    outcome = synthesize(spec, (image.width, image.height), {"input": image}, silent)
    return {"report": outcome.report, "pixels": outcome.image.pixels}


def test_t17_a_sine_has_none_and_a_ramp_has_one() -> None:
    # Neighbours of a sine of n texels differ by (2 / n) 2 sin(...) on average 4 / n, at most
    # 2 sin(pi / n), across the edge too; a ramp's step is n - 1 times its others.
    n = 64
    wave = np.sin(2 * np.pi * (np.arange(n) + 0.5) / n)
    ramp = np.arange(n) / n

    report = measured(np.tile(wave, (5, 1)))["report"]["u"]
    assert report["largest"] == pytest.approx(2 * np.sin(np.pi / n), rel=1e-5)
    assert report["ratio"] == pytest.approx(np.pi / 2, rel=0.02)

    report = measured(np.tile(ramp, (5, 1)))["report"]["u"]
    assert report["largest"] == pytest.approx((n - 1) / n, rel=1e-6)
    assert report["inside"] == pytest.approx(1 / n, rel=1e-6)
    assert report["ratio"] == pytest.approx(n - 1, rel=1e-6)


def test_t17_u_and_v_are_told_apart() -> None:
    report = measured(np.tile(np.arange(8.0)[:, None], (1, 6)))["report"]

    assert report["u"] == {"largest": 0.0, "inside": 0.0, "ratio": 0.0}
    assert report["v"] == {"largest": 7.0, "inside": 1.0, "ratio": 7.0}


def test_t17_a_seam_between_flat_halves_has_no_ratio() -> None:
    report = measured([[0.0, 1.0]])["report"]

    assert report["u"] == {"largest": 1.0, "inside": 1.0, "ratio": 1.0}
    assert measured([[2.0]])["report"]["v"] == {"largest": 0.0, "inside": 0.0, "ratio": 0.0}
    assert measured(np.array([[[0.0]], [[0.0]], [[3.0]]]))["report"]["v"]["ratio"] == 2.0


def test_t17_the_edges_meet_in_the_middle() -> None:
    pixels = np.arange(6 * 8, dtype=float).reshape(6, 8)

    np.testing.assert_array_equal(measured(pixels)["pixels"][3:, 4:, 0], pixels[:3, :4])
    np.testing.assert_array_equal(measured(pixels, shift=False)["pixels"][..., 0], pixels)


def test_t17_infinities_hide_nothing() -> None:
    report = measured([[np.nan, 1.0, np.inf], [0.0, 1.0, 5.0]])["report"]["u"]

    assert report["largest"] == 5.0
    assert np.isfinite(report["inside"])


def test_t17_noise_that_wraps_has_no_seam_and_a_warped_cut_has(make) -> None:
    noise = make({"technique": "perlin", "frequency": 6, "octaves": 3}, (96, 96))
    assert measured(noise)["report"]["u"]["ratio"] < 6
    assert measured(noise[:, :70])["report"]["u"]["ratio"] > 10
