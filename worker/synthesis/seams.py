"""Differences across the edges of a tile, against those within it (Hughes et al., 2013, 20.4)."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from worker.images.image import Image
from worker.outcome import Outcome

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.seams import SeamsSpec
    from worker.stages import Report


def synthesize(
    spec: SeamsSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Return the texture, moved by half a tile if asked for, and what was measured."""
    image = inputs["input"]
    pixels = image.pixels
    found = {"u": _seam(pixels.swapaxes(0, 1)), "v": _seam(pixels)}
    if spec.shift:
        height, width = pixels.shape[:2]
        pixels = np.roll(pixels, (height // 2, width // 2), axis=(0, 1))
    return Outcome(Image(np.ascontiguousarray(pixels), image.meaning), report=found)


def _seam(lines: NDArray[np.float32]) -> dict[str, float | None]:
    """Compare the last line with the first one; what is not finite is left out.

    Args:
        lines: (n, m, channels), neighbours along the first axis.

    Returns:
        `largest` difference across the edge, `inside` the mean one between neighbours within, and
        `ratio` of the two: 0 where there is no seam, nothing where only the seam has a difference.
    """
    largest, total = 0.0, 0.0
    with np.errstate(invalid="ignore", over="ignore"):
        across = np.abs(lines[-1].astype(np.float64) - lines[0])
        largest = float(np.max(across, initial=0.0, where=np.isfinite(across)))
        for line, following in pairwise(lines):
            step = np.abs(following.astype(np.float64) - line)
            total += float(np.sum(step, where=np.isfinite(step)))
    count = lines.size - lines[0].size
    inside = total / count if count else 0.0
    if largest == 0:
        return {"largest": 0.0, "inside": inside, "ratio": 0.0}
    return {"largest": largest, "inside": inside, "ratio": largest / inside if inside else None}
