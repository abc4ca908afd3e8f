"""Draws pictures whose holes are filled by us and, beside it, by OpenCV and scikit-image.

`python -m tests.gallery.by_example.fills <folder>`: those in the public domain go into fills.png
beside this file, all others into the folder.
"""

import os
import sys
from pathlib import Path

import numpy as np
import PIL.Image

from tests.gallery.by_example.sheets import CELL, sheet
from worker.jobs.environment import child_environment

ROOT = Path(__file__).resolve().parents[3]
FREE = ("brick", "brick, all of it", "grass")
GREY = 128


def main() -> None:
    """Draw a row for each picture: the hole, then what fills it."""
    os.environ |= child_environment(
        ROOT / ".cache", gl=os.environ.get("TEXLOOM_GL", "osmesa"), native_cpu=False
    )
    # Only now: numba and OpenBLAS read their environment when they are loaded.
    from tests.fills import PICTURES, fills, with_hole  # noqa: PLC0415

    others = Path(sys.argv[1])
    others.mkdir(parents=True, exist_ok=True)
    free, rest = [], []
    for name in PICTURES:
        whole, hole = with_hole(name)
        cells = {name: np.where(hole[..., np.newaxis], np.uint8(GREY), whole)}
        cells |= {means: fill() for means, fill in fills(whole, hole).items()}
        row = [(title, shown(pixels, hole)) for title, pixels in cells.items()]
        (free if name in FREE else rest).extend(row)
    sheet(free).save(Path(__file__).with_name("fills.png"), optimize=True)
    sheet(rest).save(others / "fills.png", optimize=True)


def shown(pixels: np.ndarray, hole: np.ndarray) -> PIL.Image.Image:
    """Return what is around the hole, made smaller where the hole is large."""
    picture = PIL.Image.fromarray(pixels[..., 0] if pixels.shape[2] == 1 else pixels)
    rows, columns = np.nonzero(hole)
    middle = [int((line.min() + line.max()) / 2) for line in (columns, rows)]
    half = CELL // 2 * (1 + int(np.ptp(rows) * 4 > 3 * CELL))
    box = [at + step for step in (-half, half) for at in middle]
    return picture.crop(box).resize((CELL, CELL), PIL.Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main()
