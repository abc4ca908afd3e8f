"""How long a request will take and how much memory it will hold, from its numbers alone.

The constants were measured on two cores of a 2.5 GHz server processor and rounded up; the model
only has to tell a second from a minute and a megabyte from a gigabyte.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from api_schemas.assets import AssetFacts, ImageFacts, ModelFacts
from api_schemas.cost import Cost
from api_schemas.coverage import coverage
from api_schemas.families import TextureSpec
from api_schemas.geometry import IDENTITY, Affine, affine
from api_schemas.maps import ColorMap, NormalMap, NumberMap
from api_schemas.model_mesh import ModelMesh
from api_schemas.output import Output
from api_schemas.requests import RenderRequest, Request
from api_schemas.scene import Node
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import parts

SECONDS_TO_START = 0.01
SECONDS_PER_ENCODED_PIXEL = 1.5e-7
SECONDS_PER_SAMPLE = 4e-8
SECONDS_PER_SHADED_SAMPLE = 6e-8
SECONDS_PER_LIGHT_SAMPLE = 1e-8
SECONDS_PER_MAP_SAMPLE = {
    "nearest": 1e-8,
    "bilinear": 1e-8,
    "trilinear": 2e-8,
    "anisotropic": 1.5e-7,
}
SECONDS_TO_COMPILE_A_MAP = 0.12
SECONDS_PER_TRIANGLE = 4e-7
SECONDS_PER_DRAWN_TRIANGLE = 5e-8
SECONDS_PER_TEXEL = 1e-7
BYTES_PER_TEXEL = 64
BYTES_PER_KEPT_TEXEL = 24
BYTES_PER_TRIANGLE = 200
BYTES_PER_PIXEL = 48
BYTES_PER_SAMPLE = 52
TILE_SIDE = 2048
MAPS = ColorMap | NumberMap | NormalMap
BYTES_PER_TILE = TILE_SIDE * TILE_SIDE * BYTES_PER_SAMPLE


def estimate(request: Request, facts: Mapping[str, AssetFacts]) -> Cost:
    """Return the cost of a request; `facts` knows the assets it speaks of by SHA-256."""
    cost = _encoding(request.output)
    width, height = request.output.size
    if isinstance(request, RenderRequest):
        return cost + _drawing(request, facts)
    return cost + _textures(request, facts, width * height)


def _encoding(output: Output) -> Cost:
    pixels = output.size[0] * output.size[1]
    return Cost(
        SECONDS_TO_START + pixels * SECONDS_PER_ENCODED_PIXEL, float(pixels * BYTES_PER_PIXEL)
    )


def _textures(value: object, facts: Mapping[str, AssetFacts], pixels: int) -> Cost:
    cost = Cost()
    for _, part in parts(value):
        if isinstance(part, ImageSpec) and (texels := _texels(part, facts)):
            cost += Cost(texels * SECONDS_PER_TEXEL, texels * BYTES_PER_TEXEL)
        if isinstance(part, TextureSpec):
            cost += part.cost(pixels)
    return cost


def _texels_worn(texture: TextureSpec, facts: Mapping[str, AssetFacts]) -> int:
    """Return how large a texture is on a surface: uploaded pictures stay as large as they are."""
    texels = _texels(texture, facts) if isinstance(texture, ImageSpec) else 0
    return texels or texture.surface_side**2


def _texels(picture: ImageSpec, facts: Mapping[str, AssetFacts]) -> int:
    found = facts.get(picture.asset)
    return found.width * found.height if isinstance(found, ImageFacts) else 0


def _drawing(request: RenderRequest, facts: Mapping[str, AssetFacts]) -> Cost:
    width, height = (side * request.output.supersampling for side in request.output.size)
    samples = width * height
    tiles = math.ceil(width / TILE_SIDE) * math.ceil(height / TILE_SIDE)
    cost = Cost(
        samples * SECONDS_PER_SAMPLE, float(min(samples * BYTES_PER_SAMPLE, BYTES_PER_TILE))
    )
    scene = request.scene
    lighting = SECONDS_PER_SHADED_SAMPLE + len(scene.lights or []) * SECONDS_PER_LIGHT_SAMPLE
    making = 0.0
    made = set()
    for node, placed in _placed(scene.nodes, IDENTITY):
        if node.mesh is None:
            continue
        if isinstance(node.mesh, ModelMesh):
            cost += _model(node.mesh, facts, samples, tiles, lighting)
            continue
        triangles = node.mesh.triangles
        cost += Cost(tiles * triangles * SECONDS_PER_DRAWN_TRIANGLE)
        if (mesh := node.mesh.model_dump_json()) not in made:
            made.add(mesh)
            cost += Cost(triangles * SECONDS_PER_TRIANGLE, triangles * BYTES_PER_TRIANGLE)
        maps = [part for _, part in parts(node.surface) if isinstance(part, MAPS)]
        shading = lighting + sum(SECONDS_PER_MAP_SAMPLE[item.filter] for item in maps)
        covered = coverage(node.mesh.reach, placed, scene.camera, width / height)
        cost += Cost(samples * covered * shading)
        for item in maps:
            picture = f"{type(item).__name__} {item.texture.model_dump_json()}"
            if picture not in made:
                made.add(picture)
                picture_cost = _textures(item.texture, facts, item.texture.surface_side**2)
                making = max(making, picture_cost.bytes)
                texels = _texels_worn(item.texture, facts)
                cost += Cost(picture_cost.seconds, texels * BYTES_PER_KEPT_TEXEL)
            if (program := f"{picture} {item.filter} {item.wrap}") not in made:
                made.add(program)
                cost += Cost(SECONDS_TO_COMPILE_A_MAP)
    # Equal things are made once, one after another, and kept: only the largest counts twice.
    return cost + Cost(bytes=making)


def _model(
    mesh: ModelMesh, facts: Mapping[str, AssetFacts], samples: int, tiles: int, lighting: float
) -> Cost:
    found = facts.get(mesh.asset)
    if not isinstance(found, ModelFacts):
        return Cost()
    pictures = [facts.get(asset) for asset in mesh.files.values()]
    texels = found.texels + sum(
        picture.width * picture.height for picture in pictures if isinstance(picture, ImageFacts)
    )
    return Cost(
        seconds=tiles * found.triangles * SECONDS_PER_DRAWN_TRIANGLE
        + found.triangles * SECONDS_PER_TRIANGLE
        + texels * SECONDS_PER_TEXEL
        + samples * (lighting + SECONDS_PER_MAP_SAMPLE["anisotropic"]),
        bytes=found.triangles * BYTES_PER_TRIANGLE + texels * (BYTES_PER_TEXEL),
    )


def _placed(nodes: Sequence[Node], parent: Affine | None) -> Iterator[tuple[Node, Affine | None]]:
    for node in nodes:
        own = affine(node.transform)
        placed = parent @ own if parent and own else None
        yield node, placed
        yield from _placed(node.children, placed)
