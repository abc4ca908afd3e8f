"""Six pictures on one, as the layout `cube` has its faces (Greene, 1986)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker import layouts
from worker.images.image import Image
from worker.images.sampling import sample
from worker.layouts.cube import cells
from worker.synthesis._resample import resample

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from api_schemas.textures.six_faces import SixFacesSpec
    from worker.stages import Report

    Pixels = NDArray[np.float32]

_TOWARDS = {"right": "+x", "left": "-x", "top": "+y", "bottom": "-y", "back": "+z", "front": "-z"}


def synthesize(
    spec: SixFacesSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Return the faces in three channels of colour, black where the arrangement has none."""
    width, height = size
    columns, rows = spec.layout.proportion
    pixels = np.zeros((height, width, 3), np.float32)
    places = cells(spec.layout)
    for name, face in _TOWARDS.items():
        column, row, on_its_head = places[face]
        down = slice(row * height // rows, (row + 1) * height // rows)
        across = slice(column * width // columns, (column + 1) * width // columns)
        room = (across.stop - across.start, down.stop - down.start)
        if min(room) == 0:
            continue  # a picture of fewer pixels than faces
        light = inputs[name].pixels[..., : 3 if inputs[name].channels >= 3 else 1]
        fitted = _fitted(light, room)
        pixels[down, across] = fitted[::-1, ::-1] if on_its_head else fitted
    return Image(pixels, "colour")


def _fitted(pixels: Pixels, size: tuple[int, int]) -> Pixels:
    """Bring a face to (width, height); unlike a tile it does not go on around its edges."""
    height, width, channels = pixels.shape
    if size[0] <= width and size[1] <= height:
        return resample(pixels, size)
    places = layouts.texel_middles(*size)
    read = [sample([pixels[..., c]], places, ("clamp", "clamp")) for c in range(channels)]
    return np.stack(read, axis=-1).reshape(size[1], size[0], channels).astype(np.float32)
