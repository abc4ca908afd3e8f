"""A request with nothing left to guess: what its digest is taken of and what the worker runs."""

from collections.abc import Mapping

from api_schemas.assets import AssetFacts, ImageFacts
from api_schemas.base import Schema
from api_schemas.families import Meaning
from api_schemas.output import Format
from api_schemas.requests import RenderRequest, Request, TextureRequest
from api_schemas.textures.image import ImageSpec
from api_schemas.turntable import Turntable
from api_schemas.walk import rewrite


def normalise(request: Request, file_format: Format, facts: Mapping[str, AssetFacts]) -> Request:
    """Settle the file format, the encoding of every uploaded picture and the frame of a turn.

    `auto` becomes srgb for pictures of 8 or 16 bits in the place of a colour, else linear.
    """

    def settle(part: Schema, meaning: Meaning) -> Schema:
        if isinstance(part, Turntable) and part.frame is not None:
            return part.model_copy(update={"frame": part.frame % part.frames})
        if not isinstance(part, ImageSpec) or part.encoding != "auto":
            return part
        asset = facts[part.asset]
        encoded = meaning == "colour" and isinstance(asset, ImageFacts) and not asset.float
        return part.model_copy(update={"encoding": "srgb" if encoded else "linear"})

    settled: TextureRequest | RenderRequest = rewrite(request, settle)
    return formatted(settled, file_format)


def formatted(request: Request, file_format: Format) -> Request:
    """Settle the file format."""
    output = request.output.model_copy(update={"format": file_format})
    return request.model_copy(update={"output": output})
