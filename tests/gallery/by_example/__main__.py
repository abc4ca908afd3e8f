"""Draws every exemplar of the corpus by every technique that makes new texture out of old.

`python -m tests.gallery.by_example <folder>`: a sheet for each exemplar. Those whose exemplar is in
the public domain go beside this file, the others into the folder; the figures go into README.md.
"""

import os
import sys
import time
from pathlib import Path
from typing import Any

from tests.conftest import corpus_folder
from tests.gallery.by_example.figures import table_of_distances, table_of_means
from tests.gallery.by_example.sheets import CELL, sheet
from worker.jobs.environment import child_environment

ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).parent
EXEMPLAR = 96
EXEMPLARS = {
    "brick": ("skimage/brick.png", 4),
    "grass": ("skimage/grass.png", 3),
    "camera": ("skimage/camera.png", 5),
    "chessboard": ("skimage/chessboard_GRAY.png", 1),
    "water": ("embark/1.jpg", 3),
    "water_grey": ("embark/1_bw.jpg", 3),
    "ink": ("embark/2.jpg", 4),
    "circles": ("embark/4.png", 2),
    "masonry": ("embark/bricks.png", 3),
    "reef_1": ("embark/multiexample/1.jpg", 4),
    "reef_2": ("embark/multiexample/2.jpg", 4),
    "bayer": ("oiio/bayer.png", 1),
    "checker": ("oiio/checker.tx", 2),
    "grid": ("oiio/grid.tif", 6),
    "tahoe": ("oiio/tahoe-tiny.tif", 1),
}
"""By name: the file, and by how much it is made smaller before its upper left is taken."""
FREE = ("brick", "grass", "camera")
METHODS: dict[str, dict[str, Any]] = {
    "texture_optimization": {},
    "graph_cut": {"block": 40},
    "image_quilting": {"block": 32},
    "ashikhmin": {},
    "wei_levoy": {},
    "efros_leung": {"window": 11},
    "by_example_noise": {"piece": 32},
    "hex_tiling": {"piece": 32},
    "wang_tiles": {"half_side": 20, "tiles": [4, 4], "exemplar_size": [EXEMPLAR, EXEMPLAR]},
    "retargeting": {},
    "hole_filling": {},
    "image_shuffling": {"shift": [32, 0]},
    "hallucination": {},
}


def main() -> None:
    """Draw all exemplars, or those named after the folder."""
    os.environ |= child_environment(
        ROOT / ".cache", gl=os.environ.get("TEXLOOM_GL", "osmesa"), native_cpu=False
    )
    # Only now: numba and OpenBLAS read their environment when they are loaded.
    from tests.gallery.by_example.drawing import drawn, read  # noqa: PLC0415

    others = Path(sys.argv[1])
    others.mkdir(parents=True, exist_ok=True)
    figures = {}
    for name in sys.argv[2:] or EXEMPLARS:
        path, shrink = EXEMPLARS[name]
        exemplar = read(corpus_folder() / "3_textures" / path, shrink, EXEMPLAR)
        cells, figures[name] = [("exemplar", exemplar)], {}
        for method, fields in METHODS.items():
            began = time.perf_counter()
            picture, figures[name][method] = drawn(method, exemplar, CELL, fields)
            figures[name][method]["seconds"] = time.perf_counter() - began
            cells.append((method, picture))
        target = (HERE if name in FREE else others) / f"{name}.png"
        sheet(cells).save(target, optimize=True)
        sys.stdout.write(f"{target}\n")
    if len(figures) == len(EXEMPLARS):
        readme = HERE / "README.md"
        told, mark, _ = readme.read_text().partition("<!-- figures -->\n")
        readme.write_text(told + mark + table_of_distances(figures) + table_of_means(figures))


if __name__ == "__main__":
    main()
