"""How long a request will take and how much memory it will hold, from its numbers alone.

The constants were measured on two cores of a 2.5 GHz server processor and rounded up; the model
only has to tell a second from a minute and a megabyte from a gigabyte.
"""

from collections.abc import Mapping

from api_schemas.assets import AssetFacts
from api_schemas.cost import Cost
from api_schemas.families import TextureSpec
from api_schemas.maps import ColorMap, NumberMap
from api_schemas.output import Output
from api_schemas.requests import RenderRequest, Request
from api_schemas.scene import Node
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import parts

SECONDS_TO_START = 0.01
SECONDS_PER_ENCODED_PIXEL = 1.5e-7
SECONDS_PER_SAMPLE = 1e-7
SECONDS_PER_MAP_SAMPLE = {
    "nearest": 1e-8,
    "bilinear": 1e-8,
    "trilinear": 2e-8,
    "anisotropic": 1.5e-7,
}
SECONDS_TO_COMPILE_A_MAP = 0.12
SECONDS_PER_TRIANGLE = 2e-7
SECONDS_PER_TEXEL = 1e-7
BYTES_PER_TEXEL = 64
BYTES_PER_KEPT_TEXEL = 24
BYTES_PER_TRIANGLE = 200
BYTES_PER_PIXEL = 48
BYTES_PER_SAMPLE = 52
BYTES_PER_TILE = 2048 * 2048 * BYTES_PER_SAMPLE


def estimate(request: Request, facts: Mapping[str, AssetFacts]) -> Cost:
    """Return the cost of a request; `facts` knows the assets it speaks of by SHA-256."""
    cost = _encoding(request.output)
    width, height = request.output.size
    if isinstance(request, RenderRequest):
        side = request.output.supersampling
        return cost + _drawing(request, facts, width * height * side * side)
    return cost + _textures(request, facts, width * height)


def _encoding(output: Output) -> Cost:
    pixels = output.size[0] * output.size[1]
    return Cost(
        SECONDS_TO_START + pixels * SECONDS_PER_ENCODED_PIXEL, float(pixels * BYTES_PER_PIXEL)
    )


def _textures(value: object, facts: Mapping[str, AssetFacts], pixels: int) -> Cost:
    cost = Cost()
    for _, part in parts(value):
        if isinstance(part, ImageSpec) and part.asset in facts:
            texels = facts[part.asset].width * facts[part.asset].height
            cost += Cost(texels * SECONDS_PER_TEXEL, texels * BYTES_PER_TEXEL)
        if isinstance(part, TextureSpec):
            cost += part.cost(pixels)
    return cost


def _texels_worn(texture: TextureSpec, facts: Mapping[str, AssetFacts]) -> int:
    """Return how large a texture is on a surface: uploaded pictures stay as large as they are."""
    if isinstance(texture, ImageSpec) and texture.asset in facts:
        return facts[texture.asset].width * facts[texture.asset].height
    return texture.surface_side**2


def _drawing(request: RenderRequest, facts: Mapping[str, AssetFacts], samples: int) -> Cost:
    cost = Cost(bytes=float(min(samples * BYTES_PER_SAMPLE, BYTES_PER_TILE)))
    making = 0.0
    per_sample = SECONDS_PER_SAMPLE
    made = set()
    for _, part in parts(request.scene):
        if isinstance(part, ColorMap | NumberMap):
            per_sample += SECONDS_PER_MAP_SAMPLE[part.filter]
            cost += Cost(SECONDS_TO_COMPILE_A_MAP)
            key = (type(part), part.texture.model_dump_json())
            if key not in made:
                made.add(key)
                picture = _textures(part.texture, facts, part.texture.surface_side**2)
                making = max(making, picture.bytes)
                texels = _texels_worn(part.texture, facts)
                cost += Cost(picture.seconds, texels * BYTES_PER_KEPT_TEXEL)
        elif isinstance(part, Node) and part.mesh is not None:
            triangles = part.mesh.triangles
            cost += Cost(triangles * SECONDS_PER_TRIANGLE, triangles * BYTES_PER_TRIANGLE)
    # Equal pictures are made once, one after another, and kept: only the largest counts twice.
    return cost + Cost(samples * per_sample, making)
