"""A small picture of work that is not finished, for those who wait."""

import math
import time
from pathlib import Path
from typing import Final, Protocol

import numpy as np

from worker.images import image_io
from worker.images.image import Image

SIDE_MAX: Final = 256
SECONDS_BETWEEN: Final = 0.5


class Progress(Protocol):
    """Told the share that is done, 0..1, the step, and what there is to see of it."""

    def __call__(self, share: float, stage: str, preview: Image | None = None) -> None:
        """Tell it."""


class Preview:
    """A PNG that is replaced whenever there is something new to see, but not too often."""

    def __init__(self, path: Path) -> None:
        """Begin with none; it will be at `path`."""
        self._path = path
        self._next = 0.0

    def show(self, image: Image) -> None:
        """Replace it by a picture, made at most SIDE_MAX long; a disk without room is no matter."""
        now = time.monotonic()
        if now < self._next:
            return
        half = self._path.with_suffix(".new.part")
        try:
            _write(_smaller(image), half)
            half.replace(self._path)
        except OSError:
            half.unlink(missing_ok=True)
        self._next = time.monotonic() + SECONDS_BETWEEN


def _smaller(image: Image) -> Image:
    """Leave out rows and columns: a glance, not a picture to keep."""
    step = math.ceil(max(image.width, image.height) / SIDE_MAX)
    return Image(np.ascontiguousarray(image.pixels[::step, ::step]), image.meaning)


def _write(image: Image, path: Path) -> None:
    image_io.write_png(
        [image],
        image.height,
        path,
        bits=8,
        transfer="srgb" if image.meaning == "colour" else "linear",
        exposure=0.0,
        tone_curve="none",
    )
