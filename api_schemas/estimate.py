"""How long a request will take and how much memory it will hold, from its numbers alone.

The constants were measured on two cores of a 2.5 GHz server processor and rounded up; the model
only has to tell a second from a minute and a megabyte from a gigabyte.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from api_schemas.assets import AssetFacts, ImageFacts, ModelFacts
from api_schemas.camera import Camera, FramedCamera, PosedCamera
from api_schemas.cost import Cost
from api_schemas.coverage import coverage, stand_in
from api_schemas.families import SurfaceSpec, TextureSpec
from api_schemas.geometry import IDENTITY, Affine, affine
from api_schemas.maps import ColorMap, NormalMap, NumberMap
from api_schemas.meshes import Mesh
from api_schemas.model_mesh import ModelMesh
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
SECONDS_PER_TRIANGLE = 4e-7
SECONDS_PER_DRAWN_TRIANGLE = 5e-8
SECONDS_PER_DRAW = 2e-4
SECONDS_PER_SORTED_TRIANGLE = 3e-7
SECONDS_PER_TEXEL = 1e-7
BYTES_PER_TEXEL = 64
BYTES_PER_KEPT_TEXEL = 24
BYTES_PER_TRIANGLE = 200
MAPS = ColorMap | NumberMap | NormalMap
_Drawn: TypeAlias = tuple[Mesh, SurfaceSpec | None, Affine | None]
"""A mesh, its surface, and where it stands."""


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
    drawn = list(_drawn(scene.nodes, IDENTITY))
    camera = _known_camera(scene.camera, drawn, width / height)
    lighting = SECONDS_PER_SHADED_SAMPLE + len(scene.lights or []) * SECONDS_PER_LIGHT_SAMPLE
    textures = _WornTextures(facts)
    cost += textures.cost(_maps(scene.background))
    cost += Cost(width * height * _seconds_per_sample(_maps(scene.background)))
    made = set()
    for mesh, surface, placed in drawn:
        if isinstance(mesh, ModelMesh):
            cost += _model(mesh, facts, samples, tiles, lighting)
            continue
        triangles = mesh.triangles
        cost += Cost(tiles * (SECONDS_PER_DRAW + triangles * SECONDS_PER_DRAWN_TRIANGLE))
        if (key := mesh.model_dump_json()) not in made:
            made.add(key)
            cost += Cost(triangles * SECONDS_PER_TRIANGLE, triangles * BYTES_PER_TRIANGLE)
        maps = _maps(surface)
        covered = coverage(mesh.reach, placed, camera, width / height)
        if surface is not None and surface.alpha_mode == "blend":
            covered *= 2  # what is behind its front is shaded too
            cost += Cost(triangles * SECONDS_PER_SORTED_TRIANGLE)
        cost += Cost(samples * covered * (lighting + _seconds_per_sample(maps)))
        cost += textures.cost(maps)
    # Equal things are made once, one after another, and kept: only the largest counts twice.
    return cost + Cost(bytes=textures.making)


def _maps(value: object) -> list[MAPS]:
    return [part for _, part in parts(value) if isinstance(part, MAPS)]


def _seconds_per_sample(maps: Sequence[MAPS]) -> float:
    return sum(SECONDS_PER_MAP_SAMPLE[item.filter] for item in maps)


def _known_camera(camera: Camera | None, drawn: Sequence[_Drawn], aspect: float) -> Camera | None:
    """Return the eye, or one about where it will be, unless uploaded models decide that."""
    if isinstance(camera, PosedCamera):
        return camera
    balls = [(mesh.reach, at) for mesh, _, at in drawn if not isinstance(mesh, ModelMesh)]
    if len(balls) < len(drawn):
        return None
    framed = camera if isinstance(camera, FramedCamera) else FramedCamera(type="framed")
    return stand_in(framed, balls, aspect)


class _WornTextures:
    """What the textures of maps cost: each picture and each program counts once."""

    def __init__(self, facts: Mapping[str, AssetFacts]) -> None:
        self._facts = facts
        self._made: set[str] = set()
        self.making = 0.0
        """Bytes that the largest of them takes while it is made."""

    def cost(self, maps: Sequence[MAPS]) -> Cost:
        """Return the cost of what these maps need and no earlier ones did."""
        cost = Cost()
        for item in maps:
            picture = f"{type(item).__name__} {item.texture.model_dump_json()}"
            if picture not in self._made:
                self._made.add(picture)
                picture_cost = _textures(item.texture, self._facts, item.texture.surface_side**2)
                self.making = max(self.making, picture_cost.bytes)
                texels = _texels_worn(item.texture, self._facts)
                cost += Cost(picture_cost.seconds, texels * BYTES_PER_KEPT_TEXEL)
            if (program := f"{picture} {item.filter} {item.wrap}") not in self._made:
                self._made.add(program)
                cost += Cost(SECONDS_TO_COMPILE_A_MAP)
        return cost


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


def _drawn(nodes: Sequence[Node], parent: Affine | None) -> Iterator[_Drawn]:
    for node in nodes:
        own = affine(node.transform)
        placed = parent @ own if parent and own else None
        if node.mesh is not None:
            yield node.mesh, node.surface, placed
        yield from _drawn(node.children, placed)
