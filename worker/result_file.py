"""The finished file: a picture becomes a PNG or an EXR as the request's output says."""

from collections.abc import Iterable, Mapping
from itertools import chain
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import MEDIA_TYPES, Output, PngBits, TextureOutput
from api_schemas.version import VERSION
from worker.images import image_io
from worker.images.image import Image
from worker.rendering.packing import PICTURE, SHADING_DIFFERENCE

_EXR_NAMES = {
    PICTURE: "",
    "depth": "Z",
    "position": "P",
    "normal": "N",
    "geometric_normal": "Ng",
    "tangent": "T",
}
_SHORTEST_FOOTPRINT = np.float32(2**-16)


def write(
    bands: Iterable[Mapping[str, Image]],
    output: Output,
    digest: str,
    path: Path,
    attributes: Mapping[str, str] = MappingProxyType({}),
) -> str:
    """Write a picture, or one layer of it, to a path and return the file's media type.

    A PNG holds straight alpha and, for colour, sRGB after exposure and tone curve; an EXR holds
    the linear premultiplied light itself and every layer. Equal arguments give equal bytes,
    however the picture is cut into bands.

    Args:
        bands: The rows from the top: the picture as PICTURE, and layers by their names.
        output: What kind of file is wanted.
        digest: Of the request.
        path: Where the file goes.
        attributes: What an EXR says of itself besides.

    Raises:
        OSError: The file cannot be written.
    """
    _, height = output.file_size
    if output.format == "exr":
        image_io.write_exr(
            ({_EXR_NAMES.get(name, name): band[name] for name in band} for band in bands),
            height,
            path,
            pixel_type=output.exr_type,
            digest=digest,
            version=VERSION,
            mipmaps=isinstance(output, TextureOutput) and output.mipmaps,
            parts=isinstance(output, TextureOutput) and output.has_parts,
            attributes=attributes,
        )
        return MEDIA_TYPES["exr"]
    pictures = (_shown(band, output.png_bits) for band in bands)
    first = next(pictures)
    transfer = output.encoding
    if transfer == "auto":
        transfer = "srgb" if first.meaning == "colour" else "linear"
    image_io.write_png(
        chain([first], pictures),
        height,
        path,
        bits=output.png_bits,
        transfer=transfer,
        exposure=output.exposure,
        tone_curve=output.tone_curve,
    )
    return MEDIA_TYPES["png"]


def _shown(band: Mapping[str, Image], bits: PngBits) -> Image:
    """Return what a PNG shows: the picture, or the layer beside it in numbers from 0 to 1.

    Directions and differences are x / 2 + 1/2. Depth is 1 / (1 + Z): bright near the eye, black
    where nothing is. An id is its own code. uv are red and green. Footprints are the logarithms of
    their lengths: 16 octaves from black. Densities are x / (1 + x). What else lies outside
    of 0..1 is cut off.
    """
    name, image = list(band.items())[-1]
    pixels = image.pixels
    if name == SHADING_DIFFERENCE:
        return Image(pixels * np.float32(0.5) + np.float32(0.5), "data")
    if name in ("normal", "geometric_normal", "tangent"):
        pixels = pixels * np.float32(0.5) + np.float32(0.5)
    elif name == "depth":
        pixels = np.reciprocal(np.float32(1) + pixels)
    elif name in ("object_id", "material_id"):
        pixels = pixels / np.float32(2**bits - 1)
    elif name == "texel_density":
        pixels = pixels / (np.float32(1) + pixels)
    elif name == "footprint":
        lengths = np.maximum(np.hypot(pixels[..., 0::2], pixels[..., 1::2]), _SHORTEST_FOOTPRINT)
        pixels = _two_colours((1 + np.log2(lengths) / 16).astype(np.float32))
    elif name == "uv":
        pixels = _two_colours(pixels)
    return Image(pixels, image.meaning)


def _two_colours(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Let two channels be red and green."""
    return np.concatenate([pixels, np.zeros_like(pixels[..., :1])], axis=2)
