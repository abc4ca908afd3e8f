"""Holes filled by us, OpenCV and scikit-image: seconds, medians of 3, compilation excluded.

PSNR (dB) is how near the hole is to what was there: grey in the middle is near to everything, so a
smear wins wherever nobody could know what was there. `coherence` is how far 9 x 9 patches of the
hole are from the nearest outside, 0..1 at half the size: less is better. `detail` is how much a
pixel of the hole differs from the next, as a share of those outside: 1 is as sharp as they are.
Ours includes the report on quality. Where there is no corpus (TEXLOOM_CORPUS) there is no row.
"""

from statistics import median
from time import perf_counter
from typing import Any

from tests.conftest import corpus_folder
from tests.fills import PICTURES, coherence, detail, fills, psnr, with_hole

REPEATS = 3


def measure() -> list[dict[str, Any]]:
    """Fill every hole by every means, in turns."""
    if not (corpus_folder() / "3_textures").is_dir():
        return [{"picture": "none", "note": "no corpus here"}]
    return [row for name in PICTURES for row in rows(name)]


def rows(name: str) -> list[dict[str, Any]]:
    """Return a row for each means."""
    whole, hole = with_hole(name)
    height, width = hole.shape
    # What the file with a hole of its own had there before is not known
    known = PICTURES[name][1] is not None
    found = []
    for means, fill in fills(whole, hole).items():
        made = fill()
        found.append(
            {
                "picture": f"{name}: {hole.sum()} of {width} x {height} pixels",
                "filled by": means,
                "seconds": round(typical(fill), 3),
                "PSNR": round(psnr(made, whole, hole), 1) if known else "",
                "coherence": coherence(made, hole),
                "detail": round(detail(made, hole), 2),
            }
        )
    return found


def typical(fill: Any) -> float:
    seconds = []
    for _ in range(REPEATS):
        start = perf_counter()
        fill()
        seconds.append(perf_counter() - start)
    return median(seconds)
