"""One exemplar drawn by one technique, and what there is to measure of it."""

from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
from numpy.typing import NDArray

from api_schemas.language import FAMILIES
from tests.growing import TEXTURE, upload
from worker.images import image_io
from worker.images.colour import srgb_from_linear
from worker.images.image import Image
from worker.synthesis import outcome
from worker.synthesis._resample import resample
from worker.synthesis.by_example.features import FeatureSpace
from worker.synthesis.by_example.pyramid import halved
from worker.synthesis.by_example.quality import patch_distance, repetition, seam

Pixels = NDArray[np.float32]
Figures = dict[str, float | None]


def read(path: Path, shrink: int, side: int) -> PIL.Image.Image:
    """Return the upper left of a picture of the corpus, made smaller."""
    pixels = image_io.read(path, "srgb", "colour", alpha=False).pixels
    height, width, channels = pixels.shape
    colours = pixels[..., : 3 if channels > 2 else 1]
    small = resample(np.ascontiguousarray(colours), (width // shrink, height // shrink))
    return _shown(small[:side, :side])


def drawn(
    technique: str, exemplar: PIL.Image.Image, side: int, fields: dict[str, Any]
) -> tuple[PIL.Image.Image, Figures]:
    """Return a picture made of an exemplar, and its figures."""
    pixels = _linear(exemplar)
    height, width = pixels.shape[:2]
    pictures, body = {upload(0)["asset"]: pixels}, {"technique": technique, **fields}
    body["input" if technique == "wang_tiles" else "exemplar"] = upload(0)
    size = (width, height)
    if technique in ("hole_filling", "image_shuffling"):
        region = np.zeros((height, width, 1), np.float32)
        region[height // 3 : 2 * height // 3, width // 6 : width // 2] = 1
        body["hole" if technique == "hole_filling" else "region"] = upload(1)
        pictures[upload(1)["asset"]] = region
    elif technique == "hallucination":
        # What is made finer is the exemplar, made coarser before
        pictures[upload(1)["asset"]] = resample(pixels, (width // 2, height // 2))
        body["target"] = upload(1)
    elif technique == "retargeting":
        size = (width * 5 // 3, height)
    else:
        size = (side, side)
    if FAMILIES["textures"][technique].sized and technique != "wang_tiles":
        body["size"] = list(size)

    def load(spec: Any, meaning: Any) -> Image:
        return Image(np.ascontiguousarray(pictures[spec.asset]), meaning)

    made = outcome(TEXTURE.validate_python(body), size, load)
    return _shown(made.image.pixels), _figures(made.image, pixels, made.report.get("quality", {}))


def _figures(image: Image, exemplar: Pixels, quality: dict[str, float | None]) -> Figures:
    """Return how good a picture is; what is told of a coordinate map, where there is one."""
    space = FeatureSpace.of(Image(exemplar, "colour"))
    ours, theirs = (space.encode(picture) for picture in (image, Image(exemplar, "colour")))
    ours_half, known = halved(ours, np.ones(ours.shape[:2], bool))
    theirs_half, usable = halved(theirs, np.ones(theirs.shape[:2], bool))
    return {
        "to": patch_distance(ours_half, known, theirs_half, usable),
        "from": patch_distance(theirs_half, usable, ours_half, known),
        "coherent": quality.get("coherent"),
        "verbatim": quality.get("verbatim"),
        "longest_run": quality.get("longest_run"),
        "repetition": repetition(ours),
        "seam": seam(ours),
    }


def _linear(picture: PIL.Image.Image) -> Pixels:
    values = np.asarray(picture, np.float32) / np.float32(255)
    values = values[..., np.newaxis] if values.ndim == 2 else values
    high = ((values + np.float32(0.055)) / np.float32(1.055)) ** np.float32(2.4)
    return np.where(values <= np.float32(0.04045), values / np.float32(12.92), high)


def _shown(pixels: Pixels) -> PIL.Image.Image:
    encoded = np.rint(np.clip(srgb_from_linear(np.ascontiguousarray(pixels)), 0, 1) * 255)
    values = encoded.astype(np.uint8)
    return PIL.Image.fromarray(values[..., 0] if values.shape[2] == 1 else values[..., :3])
