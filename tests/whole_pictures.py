"""Files of pictures that are held whole; the product writes them in bands."""

from collections.abc import Mapping
from pathlib import Path

from api_schemas.output import ExrType, PngBits, ToneCurve
from worker.images.codes import Transfer
from worker.images.image import Image
from worker.images.image_io import write_exr, write_png


def encode_png(
    image: Image,
    path: Path,
    *,
    bits: PngBits,
    transfer: Transfer,
    exposure: float = 0.0,
    tone_curve: ToneCurve = "none",
) -> None:
    """Write a whole picture as `write_png` writes one in bands."""
    write_png(
        [image],
        image.height,
        path,
        bits=bits,
        transfer=transfer,
        exposure=exposure,
        tone_curve=tone_curve,
    )


def encode_exr(
    layers: Mapping[str, Image],
    path: Path,
    *,
    pixel_type: ExrType,
    digest: str,
    version: str,
) -> None:
    """Write whole pictures as `write_exr` writes them in bands."""
    height = max((image.height for image in layers.values()), default=0)
    write_exr([layers], height, path, pixel_type=pixel_type, digest=digest, version=version)
