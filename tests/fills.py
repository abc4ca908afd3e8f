"""Pictures with holes, filled by hole_filling and by what OpenCV and scikit-image have for it.

Peers continue what is at the rim as smoothly as they can: Telea (2004), Bertalmio et al. (2001,
like a flow of Navier and Stokes) and biharmonic equations (Damelin and Hoang, 2018). All work on
the same 8 bits.
"""

from collections.abc import Callable

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage.restoration import inpaint_biharmonic

from tests.conftest import corpus_folder
from tests.growing import grow
from worker.images import image_io
from worker.images.colour import linear_from_srgb, srgb_from_linear
from worker.synthesis.by_example.pyramid import halved
from worker.synthesis.by_example.quality import patch_distance

Bytes = NDArray[np.uint8]
Mask = NDArray[np.bool_]

PICTURES = {
    "brick": ("skimage/brick.png", 256),
    "brick, all of it": ("skimage/brick.png", 512),
    "grass": ("skimage/grass.png", 256),
    "water": ("embark/1.jpg", 256),
    "masonry": ("embark/bricks.png", None),
}
"""By name: the file of the corpus, and the side of what is taken of it."""
_RADIUS = 5


def with_hole(name: str) -> tuple[Bytes, Mask]:
    """Read a picture, (height, width, channels), and which of its pixels are a hole.

    That is where its alpha is not 1, or, where it has none, a fifth of its height and a quarter of
    its width.
    """
    file, side = PICTURES[name]
    image = image_io.read(corpus_folder() / "3_textures" / file, "srgb", "colour")
    pixels = image.pixels[:side, :side]
    if image.has_alpha:
        # One pixel more: those beside the hole are dark of it
        hole = cv2.dilate(np.uint8(pixels[..., -1] < 1), np.ones((3, 3))) > 0
        return _encoded(pixels[..., :-1]), hole
    height, width = pixels.shape[:2]
    hole = np.zeros((height, width), bool)
    hole[height * 2 // 5 : height * 3 // 5, width * 3 // 8 : width * 5 // 8] = True
    return _encoded(pixels), hole


def fills(whole: Bytes, hole: Mask) -> dict[str, Callable[[], Bytes]]:
    """Return what fills the hole of a picture, black until then, by name."""
    broken = np.where(hole[..., np.newaxis], np.uint8(0), whole)
    linear = linear_from_srgb(broken.astype(np.float32) / np.float32(255))
    flat = broken[..., 0] if broken.shape[2] == 1 else broken
    mask, floats = hole.astype(np.uint8), hole[..., np.newaxis].astype(np.float32)

    def ours() -> Bytes:
        made = grow("hole_filling", linear, linear.shape[1::-1], hole=floats)
        return np.where(hole[..., np.newaxis], _encoded(made.image.pixels), whole)

    def theirs(way: int) -> Bytes:
        return cv2.inpaint(flat, mask, _RADIUS, way).reshape(whole.shape)

    def biharmonic() -> Bytes:
        made = inpaint_biharmonic(flat, hole, channel_axis=-1 if flat.ndim == 3 else None)
        return _bytes(np.clip(made, 0, 1)).reshape(whole.shape)

    return {
        "hole_filling": ours,
        "OpenCV, Telea": lambda: theirs(cv2.INPAINT_TELEA),
        "OpenCV, Navier-Stokes": lambda: theirs(cv2.INPAINT_NS),
        "scikit-image, biharmonic": biharmonic,
    }


def psnr(made: Bytes, whole: Bytes, hole: Mask) -> float:
    """Return how near the hole is to what was there, in decibels."""
    return float(10 * np.log10(255**2 / np.mean((made.astype(float) - whole)[hole] ** 2)))


def coherence(made: Bytes, hole: Mask) -> float | None:
    """Return how far 9 x 9 patches of the hole are from the nearest outside, 0..1, at half size."""
    ours, theirs = halved(made, hole), halved(made, ~hole)
    return patch_distance(*ours, *theirs)


def detail(made: Bytes, hole: Mask) -> float:
    """Return how much pixels of the hole differ from the next, as a share of those outside."""
    steps = np.abs(np.diff(made.astype(float), axis=1)).mean(axis=-1)
    inside, outside = hole[:, 1:] & hole[:, :-1], ~hole[:, 1:] & ~hole[:, :-1]
    return float(steps[inside].mean() / steps[outside].mean())


def _encoded(pixels: NDArray[np.float32]) -> Bytes:
    return _bytes(np.clip(srgb_from_linear(np.ascontiguousarray(pixels)), 0, 1))


def _bytes(values: NDArray[np.floating]) -> Bytes:
    return np.rint(values * 255).astype(np.uint8)
