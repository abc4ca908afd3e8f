"""An exemplar laid without end in pieces that are blended sharply (Mikkelsen, 2022).

The result is cut into triangles, whose corners are the middles of pieces from random places of the
exemplar, turned by chance. Light is blended as it is; the weights fall off quickly, and what is
light counts more.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from worker.images.colour import LUMINANCE_WEIGHTS
from worker.images.image import Image
from worker.synthesis._counter_hash import uniforms
from worker.synthesis._resample import resample
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.triangles import corners
from worker.synthesis.by_example.windows import fitting_side, whole_windows

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.hex_tiling import HexTilingSpec
    from worker.stages import Report
    from worker.synthesis.by_example.triangles import Corner

    Numbers = NDArray[np.float64]

_USE_OF_PLACES, _USE_OF_ANGLES = 0, 1


def synthesize(
    spec: HexTilingSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Blend `spec.size` pixels and bring them to (width, height).

    Raises:
        RenderError: No pixel of the exemplar may be copied.
    """
    exemplar = Exemplar.of(inputs)
    width, height = spec.size
    # Turned pieces must not reach beyond the window with their corners
    reach = math.sqrt(2) if spec.rotation else 1.0
    wanted = math.ceil(2 * reach * spec.piece) + 2 * (spec.rotation > 0)
    side = fitting_side(exemplar.usable, exemplar.shape, wanted)
    found, count = corners((height, width), max(1, int(side / (2 * reach))))
    tops = np.argwhere(whole_windows(exemplar.usable, (side, side)))
    chosen = tops[(uniforms(spec.seed, _USE_OF_PLACES, count) * len(tops)).astype(np.int64)]
    angles = spec.rotation * math.pi * (2 * uniforms(spec.seed, _USE_OF_ANGLES, count) - 1)
    picture = inputs.get("picture", exemplar.image)
    ours, theirs = (_finite(image.pixels) for image in (exemplar.image, picture))
    shown, weights = [], []
    for done, corner in enumerate(found):
        report(done / 3, "laying pieces")
        at = chosen[corner.number] + _inside(corner, angles, side)
        light = _light(_sampled(ours, at))
        weights.append(blending(corner.weight, light, spec.sharpness, spec.contrast))
        shown.append(_sampled(theirs, at))
    total = np.stack(weights).sum(axis=0)
    blended = np.einsum("ij,ijk->jk", np.stack(weights) / total, np.stack(shown))
    low, high = theirs.min(axis=(0, 1)), theirs.max(axis=(0, 1))
    pixels = np.clip(blended.reshape(height, width, -1).astype(np.float32), low, high)
    return Image(resample(pixels, size), picture.meaning)


def blending(
    barycentric: Numbers, light: Numbers, sharpness: float, contrast: float
) -> NDArray[np.float64]:
    """Return how much pieces count before weights are made to add up to one.

    Args:
        barycentric: 1 in the middle of a piece, 0 at its edge.
        light: Luminance of its pixels; what is beyond 0..1 counts as that.
        sharpness: The power of the former.
        contrast: The share that the latter has.
    """
    lit = 1 - contrast + contrast * np.clip(light, 1e-3, 1)
    return np.asarray(np.maximum(barycentric, 1e-6) ** sharpness * lit)


def _finite(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(np.nan_to_num(pixels, nan=0.0, posinf=3e38, neginf=-3e38), np.float32)


def _light(pixels: Numbers) -> Numbers:
    """Return the luminance of pixels (pixels, channels), or the first channel of fewer than 3."""
    if pixels.shape[1] < 3:
        return np.asarray(pixels[:, 0])
    return np.asarray(pixels[:, :3] @ np.array(LUMINANCE_WEIGHTS))


def _inside(corner: Corner, angles: Numbers, side: int) -> Numbers:
    """Return rows and columns within a window, (pixels, 2), that pieces show at their pixels."""
    down, right = corner.away.T
    turn = angles[corner.number]
    cosine, sine = np.cos(turn), np.sin(turn)
    turned = np.stack([cosine * down - sine * right, sine * down + cosine * right], axis=-1)
    middle = np.full(2, side // 2)
    if not angles.any():
        # Whole steps from pixel to pixel: nothing is interpolated
        turned = np.floor(corner.away)
    return np.asarray(np.clip(middle + turned, 0, side - 1))


def _sampled(pixels: NDArray[np.float32], at: Numbers) -> Numbers:
    """Return pixels at rows and columns, bilinear where these are broken, (pixels, channels)."""
    first = np.floor(at).astype(np.int64)
    share = at - first
    last = np.minimum(first + 1, np.array(pixels.shape[:2]) - 1)
    if not share.any():
        return pixels[first[:, 0], first[:, 1]].astype(np.float64)
    rows = ((first[:, 0], 1 - share[:, 0]), (last[:, 0], share[:, 0]))
    columns = ((first[:, 1], 1 - share[:, 1]), (last[:, 1], share[:, 1]))
    total = np.zeros((len(at), pixels.shape[2]))
    for row, down in rows:
        for column, right in columns:
            total += (down * right)[:, np.newaxis] * pixels[row, column]
    return total
