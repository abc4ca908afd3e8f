"""Compares pictures with the committed ones under tests/golden/<technique>/<case>.exr.

A golden picture is stored once, by `pytest --bless-missing`, and never overwritten: to change one,
delete it, bless it anew, bump the technique's revision and say so in the changelog, in one commit.
A failed comparison leaves actual, expected and difference in tests/.failures/<technique>/<case>/.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.whole_pictures import encode_exr, encode_png
from worker.images import image_io
from worker.images.image import Image

GOLDEN = Path(__file__).resolve().parent / "golden"
FAILURES = Path(__file__).resolve().parent / ".failures"

Pixels = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Thresholds:
    """How far a picture may be from its golden one; raise none of them to make a test pass.

    The error of a pixel is its worst channel's |actual - expected| / max(1, |expected|): absolute
    for ordinary values, relative for bright ones.
    """

    ordinary: float = 1e-3
    """Other Mesa and LLVM versions round differently; this stays below half an 8-bit step."""
    share_beyond: float = 5e-4
    """Pixels on a silhouette may fall to the other side: one in two thousand."""
    never: float = 0.05
    """No pixel may be this far off."""


def compare(
    actual: Image,
    name: str,
    thresholds: Thresholds = Thresholds(),
    *,
    bless_missing: bool = False,
) -> None:
    """Fail the running test when a picture is not its golden one.

    Args:
        actual: The picture just made.
        name: "<technique>/<case>", naming the golden file.
        thresholds: How far it may be off.
        bless_missing: Store a golden picture that does not exist yet, and pass.
    """
    golden = GOLDEN / f"{name}.exr"
    if not golden.exists():
        if not bless_missing:
            _write_exr(actual, FAILURES / name / "actual.exr")
            pytest.fail(
                f"There is no golden picture {golden}. Look at {FAILURES / name / 'actual.exr'}; "
                "if it is right, run this test with --bless-missing and commit the file.",
                pytrace=False,
            )
        _write_exr(actual, golden)
        return

    expected = image_io.read(golden, "linear", actual.meaning)
    complaint = find_difference(actual.pixels, expected.pixels, thresholds)
    if complaint:
        _leave_evidence(actual, expected, FAILURES / name)
        pytest.fail(f"{name}: {complaint}. See {FAILURES / name}.", pytrace=False)


def find_difference(actual: Pixels, expected: Pixels, thresholds: Thresholds) -> str:
    """Say in words what breaks a threshold; an empty text means nothing does."""
    if actual.shape != expected.shape:
        return f"the shape is {actual.shape}, the golden one's is {expected.shape}"
    if not np.isfinite(actual).all():
        return f"{np.count_nonzero(~np.isfinite(actual))} values are not finite"
    error = pixel_errors(actual, expected)
    row, column = np.unravel_index(np.argmax(error), error.shape)
    worst = f"worst {error[row, column]:.3g} in row {row}, column {column}"
    if error[row, column] >= thresholds.never:
        return f"an error no pixel may have, {worst} (limit {thresholds.never:g})"
    share = np.count_nonzero(error > thresholds.ordinary) / error.size
    if share > thresholds.share_beyond:
        return (
            f"{share:.2%} of the pixels are off by more than {thresholds.ordinary:g} "
            f"(limit {thresholds.share_beyond:.2%}), {worst}"
        )
    return ""


def pixel_errors(actual: Pixels, expected: Pixels) -> NDArray[np.float64]:
    """Each pixel's error, shape (height, width)."""
    wide = expected.astype(np.float64)
    error: NDArray[np.float64] = np.abs(actual - wide) / np.maximum(1.0, np.abs(wide))
    return error.max(axis=2)


def _leave_evidence(actual: Image, expected: Image, folder: Path) -> None:
    """Write the pictures as EXR for measuring and as PNG for the eye."""
    evidence = {"actual": actual, "expected": expected}
    if actual.pixels.shape == expected.pixels.shape:
        off = pixel_errors(actual.pixels, expected.pixels).astype(np.float32)
        evidence["difference"] = Image(off[..., np.newaxis], "data")
    for name, image in evidence.items():
        _write_exr(image, folder / f"{name}.exr")
        visible = image
        if name == "difference" and image.pixels.max() > 0:
            visible = Image(image.pixels / image.pixels.max(), "data")
        encode_png(
            visible,
            folder / f"{name}.png",
            bits=8,
            transfer="srgb" if visible.meaning == "colour" else "linear",
        )


def _write_exr(image: Image, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    encode_exr({"": image}, path, pixel_type="float", digest="", version="")
