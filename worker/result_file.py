"""The finished file: a picture becomes a PNG or an EXR as the request's output says."""

from pathlib import Path

from api_schemas.output import MEDIA_TYPES, Output
from api_schemas.version import VERSION
from worker.images import image_io
from worker.images.image import Image


def write(image: Image, output: Output, digest: str, path: Path) -> str:
    """Write a picture to a path and return the file's media type.

    A PNG holds straight alpha and, for colour, sRGB after exposure and tone curve; an EXR holds
    the linear premultiplied light itself. Equal arguments give equal bytes.
    """
    if output.format == "exr":
        image_io.encode_exr(
            {"": image},
            path,
            pixel_type=output.exr_type,
            digest=digest,
            version=VERSION,
        )
        return MEDIA_TYPES["exr"]
    transfer = output.encoding
    if transfer == "auto":
        transfer = "srgb" if image.meaning == "colour" else "linear"
    image_io.encode_png(
        image,
        path,
        bits=output.png_bits,
        transfer=transfer,
        exposure=output.exposure,
        tone_curve=output.tone_curve,
    )
    return MEDIA_TYPES["png"]
