"""How long a request will take and how much memory it will hold, from its numbers alone.

The constants were measured on two cores of a 2.5 GHz server processor and rounded up; the model
only has to tell a second from a minute and a megabyte from a gigabyte.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from api_schemas.assets import AssetFacts, ImageFacts
from api_schemas.base import Schema
from api_schemas.bodies import (
    BYTES_PER_KEPT_TEXEL,
    BYTES_PER_TEXEL,
    SECONDS_PER_TEXEL,
    Body,
    body,
    displaced,
    framed,
)
from api_schemas.by_example import FromExemplarSpec
from api_schemas.camera import Camera, FramedCamera, ModelCamera, PosedCamera
from api_schemas.cookies import Cookie
from api_schemas.coordinates.triplanar import TriplanarSpec
from api_schemas.cost import Cost
from api_schemas.coverage import coverage, stand_in
from api_schemas.environment import SKY_LAMPS
from api_schemas.families import TextureSpec
from api_schemas.geometry import IDENTITY, Affine, Vector3, affine
from api_schemas.light_cost import cookies_of, seconds_of_shadows, shadow_maps
from api_schemas.lights import LIGHTS_MAX
from api_schemas.output_cost import samples_of, sampling, tiles_of, writing
from api_schemas.own_size import FUNCTION_SIZE, Size, size_within
from api_schemas.relief import AnyMap, ParallaxMap
from api_schemas.requests import RenderRequest, Request
from api_schemas.scene import Node
from api_schemas.sky import SKY_SECONDS_PER_SAMPLE, sky_textures, surroundings_cost
from api_schemas.solid import is_carved, worn_depth
from api_schemas.stored_cost import at_once, form_of, storing
from api_schemas.surface_spec import SurfaceSpec
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import BRANCHES, fields_within, outermost, parts

SECONDS_PER_SHADED_SAMPLE = 6e-8
SECONDS_PER_LIGHT_SAMPLE = 1e-8
SECONDS_PER_SKY_LAMP = 1e-7
SECONDS_PER_MAP_SAMPLE = {
    "nearest": 1e-8,
    "bilinear": 1e-8,
    "trilinear": 2e-8,
    "anisotropic": 1.5e-7,
    "ewa": 6e-7,
    "ripmap": 1e-7,
    "summed_area": 5e-7,
    "formula": 4e-7,
}
SECONDS_PER_PARALLAX_STEP = 2e-8
SECONDS_PER_STEP = 1e-8
SECONDS_TO_COMPILE_A_MAP = 0.12
SECONDS_TO_COMPILE_A_FORMULA = 0.4
SECONDS_PER_DRAWN_TRIANGLE = 5e-8
SECONDS_PER_DRAW = 2e-4
SECONDS_PER_SORTED_TRIANGLE = 3e-7
MAPS_OF_A_MATERIAL = 3
"""Of a material of a model, where facts tell of pictures at all: colour, normals and the rest."""
LIGHTS_OF_A_STUDIO = 2
MAPS = AnyMap
_Drawn: TypeAlias = tuple[Node, Affine | None, Body]
"""A node, where the middle of its mesh stands, and what that mesh is."""


def estimate(request: Request, facts: Mapping[str, AssetFacts]) -> Cost:
    """Return the cost of a request; `facts` knows the assets it speaks of by SHA-256."""
    written = writing(request.output)
    width, height = request.output.size
    if isinstance(request, RenderRequest):
        return written + _drawing(request, facts)
    if request.output.slices:
        made = volume_of(request.texture, width * height * request.output.slices)
    else:
        made = _textures(request, facts, (width, height))
    return made.then(written)  # which counts the picture itself


def volume_of(texture: TextureSpec, voxels: int) -> Cost:
    """Return the cost of making a solid texture, with all that are in it."""
    found = (part for _, part in parts(texture) if isinstance(part, TextureSpec))
    return sum((part.volume_cost(voxels) for part in found), Cost())


def _textures(value: object, facts: Mapping[str, AssetFacts], size: Size) -> Cost:
    def measure(picture: ImageSpec) -> Size:
        found = facts.get(picture.asset)
        return (found.width, found.height) if isinstance(found, ImageFacts) else FUNCTION_SIZE

    cost = Cost()
    for texture in outermost(value, TextureSpec):
        if isinstance(texture, ImageSpec) and (texels := _texels(texture, facts)):
            cost += Cost(texels * SECONDS_PER_TEXEL, texels * BYTES_PER_TEXEL)
        within: dict[str, Size] = {}
        for name, _, inner in fields_within(texture):
            if isinstance(inner, BRANCHES):
                sides = size_within(texture, name, size, measure)
                within[name] = sides
                cost += _textures(inner, facts, sides)
        if isinstance(texture, FromExemplarSpec):
            cost += texture.cost_of(within, math.prod(size))
        else:
            cost += texture.cost(math.prod(size))
    return cost


def _texels_worn(texture: TextureSpec, facts: Mapping[str, AssetFacts]) -> int:
    """Return how large a texture is on a surface: uploaded pictures stay as large as they are."""
    texels = _texels(texture, facts) if isinstance(texture, ImageSpec) else 0
    return texels or math.prod(texture.surface_size)


def _texels(picture: ImageSpec, facts: Mapping[str, AssetFacts]) -> int:
    found = facts.get(picture.asset)
    return found.width * found.height if isinstance(found, ImageFacts) else 0


def _drawing(request: RenderRequest, facts: Mapping[str, AssetFacts]) -> Cost:
    width, height = request.output.size
    samples, tiles = samples_of(request.output), tiles_of(request.output)
    cost = sampling(request.output)
    scene = request.scene
    drawn = [
        (node, _moved(placed, found.middle), displaced(found, node.displacement))
        for node, placed in _placed(scene.nodes, IDENTITY)
        if node.mesh is not None and (found := body(node.mesh, facts)) is not None
    ]
    camera = _known_camera(scene.camera, drawn, width / height)
    shining = (
        min(LIGHTS_MAX, max(LIGHTS_OF_A_STUDIO, sum(found.lights for _, _, found in drawn)))
        if scene.lights is None
        else len(scene.lights)
    )
    lighting = SECONDS_PER_SHADED_SAMPLE + shining * SECONDS_PER_LIGHT_SAMPLE
    lighting += seconds_of_shadows(scene.lights or [])
    cookies = cookies_of(scene.lights or [])
    # Both sides of a branch are run: every light asks every picture.
    pictures = {cookie.unit: SECONDS_PER_MAP_SAMPLE[cookie.filter] for cookie in cookies}
    lighting += shining * sum(pictures.values())
    textures = _WornTextures(facts)
    background = _maps(scene.background)
    cost += textures.cost(background) + textures.cost(cookies)
    cost += Cost(samples * _seconds_per_sample(background))
    if (environment := scene.environment) is not None:
        lighting += SKY_SECONDS_PER_SAMPLE
        if environment.gathered == "sum":
            lighting += SKY_LAMPS * SECONDS_PER_SKY_LAMP
        cost += Cost(samples * SKY_SECONDS_PER_SAMPLE) + sky_textures(environment).cost()
        cost += _textures(environment.texture, facts, environment.texture.surface_size)
        cost += Cost(bytes=_texels_worn(environment.texture, facts) * BYTES_PER_KEPT_TEXEL)
    made = set()
    once = 0.0
    for node, placed, found in drawn:
        drawing = found.draws * SECONDS_PER_DRAW + found.pieces * SECONDS_PER_DRAWN_TRIANGLE
        # Of several surfaces on one shape each draws it all, and throws away what is not its.
        passes = 1 if node.surface_map is None else len(node.surface_map.surfaces)
        cost += Cost(tiles * passes * drawing)
        once += passes * drawing
        if found.key not in made:
            made.add(found.key)
            cost += found.making
            cost += Cost(MAPS_OF_A_MATERIAL * SECONDS_TO_COMPILE_A_MAP * found.pictures)
        shown = node.surface_map or node.surface or node.mesh
        surfaces = [part for _, part in parts(shown) if isinstance(part, SurfaceSpec)]
        cost += framed(found, surfaces)
        maps = [_maps(surface) for surface in surfaces]
        among: list[MAPS] = [] if node.surface_map is None else [node.surface_map]
        for worn in [*maps, among, _maps(node.displacement)]:
            cost += textures.cost(worn)
        own = MAPS_OF_A_MATERIAL * found.pictures * SECONDS_PER_MAP_SAMPLE["anisotropic"]
        looks = [own, *(_seconds_per_surface(surface, shining) for surface in surfaces)]
        shading = passes * lighting + (sum(looks) if among else max(looks))
        if environment is not None or node.surroundings is not None:
            more = max((surface.sky_lookups - 1 for surface in surfaces), default=0)
            shading += passes * more * SKY_SECONDS_PER_SAMPLE
        # The parts of one model fill the ball side by side as well as one behind the other.
        covered = math.cbrt(found.draws)
        covered *= coverage(found.reach, placed, camera, width / height)
        if any(s.alpha_mode == "blend" and not s.fills_box for s in surfaces):
            covered *= 2  # what is behind its front is shaded too
            cost += Cost(found.pieces * SECONDS_PER_SORTED_TRIANGLE)
        cost += Cost(samples * covered * shading)
    shadows = shadow_maps(scene.lights or [], once)
    cost += Cost(request.output.frames * shadows.seconds, shadows.bytes)
    for node, _, _ in drawn:
        if node.surroundings is not None:
            cost += surroundings_cost(node.surroundings, lighting + SKY_SECONDS_PER_SAMPLE, once)
    # Equal things are made once, one after another, and kept: only the largest counts twice.
    return cost + Cost(bytes=textures.making)


def _maps(value: object) -> list[MAPS]:
    return [part for _, part in parts(value) if isinstance(part, MAPS)]


def _seconds_per_sample(maps: Sequence[MAPS]) -> float:
    """Return the seconds that looking up all of them once takes."""
    return sum(_seconds_per_look(item) for item in maps)


def _seconds_per_surface(surface: SurfaceSpec, lights: int) -> float:
    """Return the seconds that all looks of one sample take, where so many lights shine."""
    looks = surface.looks(lights)
    return looks * _seconds_per_sample(_maps(surface)) + (looks - 1) * SECONDS_PER_STEP


def _seconds_per_look(item: MAPS) -> float:
    if isinstance(item, ParallaxMap):
        return SECONDS_PER_PARALLAX_STEP * (1 if item.method == "offset" else item.steps)
    if item.filter == "formula":
        once = sum(_seconds_per_formula(part) for _, part in parts(item.texture))
    else:
        once = item.units * SECONDS_PER_MAP_SAMPLE[item.filter]
    return once * (3 if isinstance(item.coordinates, TriplanarSpec) else 1)


def _seconds_per_formula(part: Schema) -> float:
    """Return what a pixel of one formula takes, about, told from one of a picture."""
    pixels = 1 << 20
    if not isinstance(part, TextureSpec):
        return 0.0
    return SECONDS_PER_MAP_SAMPLE["formula"] + 20 * part.cost(pixels).seconds / pixels


def _moved(placed: Affine | None, middle: Vector3) -> Affine | None:
    """Return a place whose origin is what was the point `middle`."""
    if placed is None:
        return None
    return placed @ Affine(IDENTITY.x, IDENTITY.y, IDENTITY.z, middle)


def _known_camera(camera: Camera | None, drawn: Sequence[_Drawn], aspect: float) -> Camera | None:
    """Return the eye, or one about where it will be, unless an uploaded model brings it."""
    if isinstance(camera, PosedCamera):
        return camera
    brought = any(found.cameras for _, _, found in drawn)
    if isinstance(camera, ModelCamera) or (camera is None and brought):
        return None
    framed = camera or FramedCamera(type="framed")
    return stand_in(framed, [(found.reach, at) for _, at, found in drawn], aspect)


class _WornTextures:
    """What the textures of maps cost: each picture and each program counts once."""

    def __init__(self, facts: Mapping[str, AssetFacts]) -> None:
        self._facts = facts
        self._made: set[str] = set()
        self.making = 0.0
        """Bytes that the largest of them takes while it is made."""

    def cost(self, maps: Sequence[MAPS | Cookie]) -> Cost:
        """Return the cost of what these maps need and no earlier ones did."""
        cost = Cost()
        for item in maps:
            if not isinstance(item, Cookie) and item.filter == "formula":
                compiled = sum(isinstance(part, TextureSpec) for _, part in parts(item.texture))
                cost += Cost(compiled * SECONDS_TO_COMPILE_A_FORMULA)
                continue
            carved = not isinstance(item, Cookie) and is_carved(item)
            picture = f"{type(item).__name__} {carved} {item.texture.model_dump_json()}"
            texels = (
                worn_depth(item.texture) ** 3 if carved else _texels_worn(item.texture, self._facts)
            )
            if picture not in self._made:
                self._made.add(picture)
                making = (
                    volume_of(item.texture, texels)
                    if carved
                    else _textures(item.texture, self._facts, item.texture.surface_size)
                )
                self.making = max(self.making, making.bytes)
                cost += Cost(making.seconds)
            if (stored := f"{picture} {form_of(item)}") not in self._made:
                self._made.add(stored)
                self.making = max(self.making, at_once(item, texels))
                cost += storing(item, texels)
            joins = list(item.joins) if isinstance(item, Cookie) else item.wrap
            if (program := f"{picture} {item.filter} {joins}") not in self._made:
                self._made.add(program)
                cost += Cost(SECONDS_TO_COMPILE_A_MAP)
        return cost


def _placed(nodes: Sequence[Node], parent: Affine | None) -> Iterator[tuple[Node, Affine | None]]:
    for node in nodes:
        own = affine(node.transform)
        placed = parent @ own if parent and own else None
        yield node, placed
        yield from _placed(node.children, placed)
