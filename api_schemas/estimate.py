"""How long a request will take and how much memory it will hold, from its numbers alone.

The constants were measured on two cores of a 2.5 GHz server processor and rounded up; the model
only has to tell a second from a minute and a megabyte from a gigabyte.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

from api_schemas.assets import AssetFacts, ImageFacts
from api_schemas.bodies import BYTES_PER_KEPT_TEXEL, BYTES_PER_TEXEL, SECONDS_PER_TEXEL, body
from api_schemas.cost import Cost
from api_schemas.coverage import coverage
from api_schemas.families import SurfaceSpec, TextureSpec
from api_schemas.geometry import IDENTITY, Affine, Vector3, affine
from api_schemas.maps import ColorMap, Map, NormalMap, NumberMap
from api_schemas.output_cost import samples_of, sampling, tiles_of, writing
from api_schemas.requests import RenderRequest, Request
from api_schemas.scene import Node
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import parts

SECONDS_PER_SHADED_SAMPLE = 6e-8
SECONDS_PER_LIGHT_SAMPLE = 1e-8
SECONDS_PER_MAP_SAMPLE = {
    "nearest": 1e-8,
    "bilinear": 1e-8,
    "trilinear": 2e-8,
    "anisotropic": 1.5e-7,
}
SECONDS_TO_COMPILE_A_MAP = 0.12
SECONDS_PER_DRAWN_TRIANGLE = 5e-8
SECONDS_PER_DRAW = 1e-4
MAPS_OF_A_MATERIAL = 3
"""Of a material of a model, where facts tell of pictures at all: colour, normals and the rest."""
LIGHTS_OF_A_STUDIO = 2
MAPS = ColorMap | NumberMap | NormalMap


def estimate(request: Request, facts: Mapping[str, AssetFacts]) -> Cost:
    """Return the cost of a request; `facts` knows the assets it speaks of by SHA-256."""
    cost = writing(request.output)
    width, height = request.output.size
    if isinstance(request, RenderRequest):
        return cost + _drawing(request, facts)
    return cost + _textures(request, facts, width * height)


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
    width, height = request.output.size
    samples, tiles = samples_of(request.output), tiles_of(request.output)
    cost = sampling(request.output)
    scene = request.scene
    bodies = [
        (node, placed, found)
        for node, placed in _placed(scene.nodes, IDENTITY)
        if node.mesh is not None and (found := body(node.mesh, facts)) is not None
    ]
    shining = (
        max(LIGHTS_OF_A_STUDIO, sum(found.lights for _, _, found in bodies))
        if scene.lights is None
        else len(scene.lights)
    )
    lighting = SECONDS_PER_SHADED_SAMPLE + shining * SECONDS_PER_LIGHT_SAMPLE
    making = 0.0
    made = set()
    worn = [_maps(scene.background)]
    cost += Cost(samples * _sampling(worn[0]))
    for node, placed, found in bodies:
        cost += Cost(tiles * found.pieces * SECONDS_PER_DRAWN_TRIANGLE)
        cost += Cost(tiles * (found.draws - 1) * SECONDS_PER_DRAW)
        if found.key not in made:
            made.add(found.key)
            cost += found.making
            cost += Cost(MAPS_OF_A_MATERIAL * SECONDS_TO_COMPILE_A_MAP * found.pictures)
        shown = node.surface or node.mesh
        surfaces = [part for _, part in parts(shown) if isinstance(part, SurfaceSpec)]
        worn += (maps := [_maps(surface) for surface in surfaces])
        own = MAPS_OF_A_MATERIAL * found.pictures * SECONDS_PER_MAP_SAMPLE["anisotropic"]
        shading = lighting + max([own, *map(_sampling, maps)])
        covered = coverage(found.reach, _moved(placed, found.middle), scene.camera, width / height)
        # The parts of one model hide each other: few are seen one behind the other.
        cost += Cost(samples * covered * shading * math.sqrt(found.draws))
    for item in chain.from_iterable(worn):
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


def _maps(value: object) -> list[ColorMap | NumberMap | NormalMap]:
    return [part for _, part in parts(value) if isinstance(part, MAPS)]


def _sampling(maps: Sequence[Map]) -> float:
    """Return the seconds that looking up all of them once takes."""
    return sum(SECONDS_PER_MAP_SAMPLE[item.filter] for item in maps)


def _moved(placed: Affine | None, middle: Vector3) -> Affine | None:
    """Return a place whose origin is what was the point `middle`."""
    if placed is None:
        return None
    return placed @ Affine(IDENTITY.x, IDENTITY.y, IDENTITY.z, middle)


def _placed(nodes: Sequence[Node], parent: Affine | None) -> Iterator[tuple[Node, Affine | None]]:
    for node in nodes:
        own = affine(node.transform)
        placed = parent @ own if parent and own else None
        yield node, placed
        yield from _placed(node.children, placed)
