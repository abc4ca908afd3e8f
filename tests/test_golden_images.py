"""A golden comparison that cannot fail would be worse than none."""

import re
from pathlib import Path

import numpy as np
import pytest

from tests import golden_images
from tests.golden_images import Thresholds, compare
from worker.images.image import Image

THRESHOLDS = Thresholds(ordinary=0.01, share_beyond=0.02, never=0.5)


@pytest.fixture(autouse=True)
def folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(golden_images, "GOLDEN", tmp_path / "golden")
    monkeypatch.setattr(golden_images, "FAILURES", tmp_path / "failures")


@pytest.fixture
def picture() -> Image:
    """Ten by ten pixels, with one brighter than any screen; its golden picture is stored."""
    pixels = np.linspace(0, 1, 300, dtype=np.float32).reshape(10, 10, 3)
    pixels[4, 4] = 1000
    picture = Image(pixels, "colour")
    compare(picture, "made_up/case", bless_missing=True)
    return picture


def changed(picture: Image, amount: float, count: int) -> Image:
    pixels = picture.pixels.copy()
    pixels.reshape(-1, 3)[:count, 1] += np.float32(amount)
    return Image(pixels, "colour")


def failure(picture: Image) -> str:
    with pytest.raises(pytest.fail.Exception) as caught:
        compare(picture, "made_up/case", THRESHOLDS)
    return str(caught.value)


def test_the_same_picture_passes(picture: Image) -> None:
    compare(picture, "made_up/case", Thresholds(ordinary=0, share_beyond=0, never=1e-9))


def test_a_few_pixels_may_be_off_but_not_more(picture: Image) -> None:
    compare(changed(picture, 0.02, count=2), "made_up/case", THRESHOLDS)

    assert re.search(r"3\.00% of the pixels are off", failure(changed(picture, 0.02, count=3)))


def test_no_single_pixel_may_be_far_off(picture: Image) -> None:
    assert "an error no pixel may have" in failure(changed(picture, 0.6, count=1))


def test_the_error_of_a_bright_pixel_is_relative(picture: Image) -> None:
    brighter = picture.pixels.copy()
    brighter[4, 4] *= np.float32(1.005)

    compare(Image(brighter, "colour"), "made_up/case", THRESHOLDS)


def test_a_value_that_is_no_number_fails(picture: Image) -> None:
    assert "not finite" in failure(changed(picture, float("nan"), count=1))


def test_another_size_fails(picture: Image) -> None:
    assert "shape" in failure(Image(picture.pixels[:9].copy(), "colour"))


def test_a_failure_leaves_actual_expected_and_difference(picture: Image, tmp_path: Path) -> None:
    failure(changed(picture, 0.6, count=1))

    assert {path.name for path in (tmp_path / "failures/made_up/case").iterdir()} == {
        f"{name}.{kind}" for name in ("actual", "expected", "difference") for kind in ("exr", "png")
    }


def test_a_missing_golden_picture_fails_and_is_shown(picture: Image, tmp_path: Path) -> None:
    with pytest.raises(pytest.fail.Exception, match="--bless-missing"):
        compare(picture, "made_up/unknown")

    assert (tmp_path / "failures/made_up/unknown/actual.exr").exists()
    assert not (tmp_path / "golden/made_up/unknown.exr").exists()


def test_blessing_never_overwrites(picture: Image, tmp_path: Path) -> None:
    stored = (tmp_path / "golden/made_up/case.exr").read_bytes()
    with pytest.raises(pytest.fail.Exception):
        compare(changed(picture, 0.6, count=1), "made_up/case", bless_missing=True)

    assert (tmp_path / "golden/made_up/case.exr").read_bytes() == stored
