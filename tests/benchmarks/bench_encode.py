"""How long a finished picture takes to become a file; a rendered-looking picture, one process."""

import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np

from tests.whole_pictures import encode_exr, encode_png
from worker.images.image import Image

REPEATS = 9


def measure() -> list[dict[str, Any]]:
    """Encode at two sizes, in ms, medians, transfer curve and writing the file included."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture"
        for name, width, height in (("512²", 512, 512), ("1080p", 1920, 1080)):
            picture = rendered_looking(width, height)
            works = {
                "PNG 8 bit": lambda image: encode_png(image, path, bits=8, transfer="srgb"),
                "PNG 8 bit, aces": lambda image: encode_png(
                    image, path, bits=8, transfer="srgb", tone_curve="aces"
                ),
                "PNG 16 bit": lambda image: encode_png(image, path, bits=16, transfer="srgb"),
                "EXR half": lambda image: encode_exr(
                    {"": image}, path, pixel_type="half", digest="0" * 64, version="0"
                ),
                "EXR float": lambda image: encode_exr(
                    {"": image}, path, pixel_type="float", digest="0" * 64, version="0"
                ),
            }
            for work, encode in works.items():
                times = []
                for _ in range(REPEATS):
                    begin = perf_counter()
                    encode(picture)
                    times.append(perf_counter() - begin)
                rows.append(
                    {
                        "work": f"encode {work} {name}",
                        "figure": round(median(times) * 1000, 1),
                        "unit": "ms",
                        "note": f"{path.stat().st_size // 1024} KiB",
                    }
                )
    return rows


def rendered_looking(width: int, height: int) -> Image:
    """A lit ball with 16-texel blocks of texture and a soft edge over nothing, RGBA."""
    y, x = np.mgrid[0:height, 0:width].astype(np.float32)
    radius = height * 0.45
    distance = np.hypot(x - width / 2, y - height / 2)
    shade = np.sqrt(np.clip(1 - (distance / radius) ** 2, 0.02, 1))
    blocks = np.random.default_rng(1).random((height // 16 + 1, width // 16 + 1, 3))
    texture = np.kron(blocks, np.ones((16, 16, 1)))[:height, :width]
    alpha = np.clip(radius - distance + 0.5, 0, 1)[..., None]
    colour = (0.3 + 0.7 * texture) * shade[..., None] * alpha
    return Image(np.concatenate([colour, alpha], axis=2).astype(np.float32), "colour")


if __name__ == "__main__":
    for row in measure():
        print(f"{row['work']:32} {row['figure']:8} {row['unit']}  {row['note']}")
