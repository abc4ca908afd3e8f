"""All pictures of the corpus grown to 512², seconds with the report on quality, once compiled.

Distances (0..1) of 9 x 9 patches at half the size: to the exemplar's nearest (coherence) and back
(completeness). `run` is the longest line copied, as a share of the exemplar's side: half at most.
Where there is no corpus (TEXLOOM_CORPUS) there is no row.
"""

from time import perf_counter
from typing import Any

import numpy as np

from tests.conftest import corpus_folder
from tests.growing import grow, sources
from worker.images import image_io
from worker.synthesis.by_example.copies import continued, copied_so_far

SIDE = 512
PICTURES = {
    "embark": ["1.jpg", "1_bw.jpg", "2.jpg", "4.png", "bricks.png"],
    "embark/multiexample": ["1.jpg", "2.jpg"],
    "skimage": ["brick.png", "camera.png", "chessboard_GRAY.png", "grass.png"],
    "oiio": ["bayer.png", "checker.tx", "grid.tif", "tahoe-tiny.tif"],
}


def measure() -> list[dict[str, Any]]:
    """Grow each picture once, after a small one that compiles everything."""
    rows = []
    for folder, names in PICTURES.items():
        for name in names:
            path = corpus_folder() / "3_textures" / folder / name
            if path.is_file():
                pixels = image_io.read(path, "srgb", "colour").pixels
                grow("texture_optimization", pixels[:64, :64], (96, 96))
                rows.append({"exemplar": f"{folder}/{name}", **judged(pixels)})
    return rows or [{"exemplar": "none", "note": "no corpus here"}]


def judged(exemplar: np.ndarray) -> dict[str, Any]:
    start = perf_counter()
    made = grow("texture_optimization", exemplar, (SIDE, SIDE), seed=2)
    seconds = perf_counter() - start
    height, width = exemplar.shape[:2]
    across, down = continued(np.stack(sources(made, exemplar), axis=-1))
    longest = max(copied_so_far(across).max() / width, copied_so_far(down.T).max() / height)
    quality = made.report["quality"]
    return {
        "size": f"{width} x {height}",
        "coherence": quality["to_exemplar_2"],
        "completeness": quality["from_exemplar_2"],
        "run": round(float(longest), 2),
        "repetition": quality["repetition"],
        "seconds": round(seconds, 2),
    }
