"""From a request's scene to drawables: nodes placed, meshes and textures uploaded or found."""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np

from api_schemas.coordinates.uv import UvSpec
from api_schemas.families import Meaning, SurfaceSpec, TextureSpec
from api_schemas.lights import Light
from api_schemas.maps import ColorMap
from api_schemas.model_mesh import ModelMesh
from api_schemas.relief import Displacement
from api_schemas.scene import Node, Scene
from api_schemas.surfaces.phong import PhongSpec
from api_schemas.surfaces.unlit import UnlitSpec
from worker.geometry import primitives
from worker.geometry.mesh import Mesh
from worker.geometry.tangents import with_tangents
from worker.geometry.transforms import Matrix, parent_from_node
from worker.images.image import Image
from worker.images.pyramids import Cut
from worker.images.relief import Preparation, prepared
from worker.images.stored_form import BOX, StoredForm, stored
from worker.models.model import Model, Part
from worker.rendering.cache import ByteCache
from worker.rendering.cookies import Cookies, cookies_of
from worker.rendering.displacing import with_relief
from worker.rendering.lookups import TextureSource
from worker.rendering.model_changes import seen_parts
from worker.rendering.pyrender_scene import Background, Drawable, View
from worker.rendering.relief_shading import TangentsWanted, tangents_wanted
from worker.rendering.shading import Selection, Shading, shade
from worker.rendering.staging import PlacedModel, lights_of, view_of
from worker.rendering.textures import Texture
from worker.rendering.vertex_arrays import VertexArray

TEXTURE_BYTES_MAX = 128 << 20
MESH_BYTES_MAX = 64 << 20
LARGEST_LIGHT = 5e36
"""Of a picture, as in lib/picture.glsl."""
_MATT_GREY = PhongSpec(technique="phong")


class TextureMaker(Protocol):
    """Turns a texture of the language into a picture."""

    def __call__(self, spec: TextureSpec, meaning: Meaning, /) -> Image:
        """Return the picture, read as colour or as data."""


class ModelReader(Protocol):
    """Reads uploaded models."""

    def __call__(self, mesh: ModelMesh, /) -> Model:
        """Return the model."""


@dataclass(frozen=True, slots=True)
class BuiltScene:
    """What a picture is drawn from, and how much of it there is."""

    drawables: tuple[Drawable, ...]
    view: View
    lights: tuple[Light, ...]
    cookies: Cookies
    background: Background | None
    triangles: int
    texels: int
    warnings: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Placed:
    """A mesh that is kept or can be made, its surface, and where it stands.

    With a selection the surface is only where that says.
    """

    key: str
    mesh: Callable[[], Mesh]
    surface: SurfaceSpec
    world_from_object: Matrix
    node: Node
    thing: int = 0
    selection: Selection | None = None

    @property
    def worn(self) -> str:
        """What surfaces that share a program and its parameters have in common."""
        surface = self.surface.model_dump_json()
        if self.selection is None:
            return surface
        return f"{surface} {self.selection.number} {self.selection.among.model_dump_json()}"


class SceneBuilder:
    """Keeps meshes and textures of earlier scenes, by content."""

    def __init__(self) -> None:
        """Begin with nothing in OpenGL."""
        self._textures = ByteCache[Texture](TEXTURE_BYTES_MAX, Texture.delete)
        self._meshes = ByteCache[VertexArray](MESH_BYTES_MAX, VertexArray.delete)

    def build(
        self,
        scene: Scene,
        aspect: float,
        maker: TextureMaker,
        reader: ModelReader,
        *,
        tangents: bool = False,
    ) -> BuiltScene:
        """Place, upload and lay out everything in a scene.

        Args:
            scene: The request's.
            aspect: Width over height of the picture.
            maker: Makes the pictures of textures that are not kept from an earlier scene.
            reader: Reads the uploaded models.
            tangents: Whether all meshes need them, not only those with normal maps.

        Raises:
            WorkerError: The camera is degenerate, a budget is exceeded, a texture cannot be made,
                a model cannot be read or has no such part.
        """
        placed: list[_Placed] = []
        models: list[PlacedModel] = []
        things = 0
        for node, matrix in _nodes(scene.nodes, np.eye(4)):
            if isinstance(node.mesh, ModelMesh):
                model = reader(node.mesh)
                models.append(PlacedModel(model, matrix))
                found = list(_parts(node, node.mesh, model, matrix))
            elif node.mesh is not None:
                key = node.mesh.model_dump_json()
                make = partial(primitives.build, node.mesh)
                found = [_Placed(key, make, node.surface or _MATT_GREY, matrix, node)]
            else:
                continue
            if node.displacement is not None:
                found = [_displaced(item, node.displacement, maker) for item in found]
            for item in found:
                things += 1
                placed += _selected(replace(item, thing=things))
        kept = [self._kept(item, tangents) for item in placed]
        worn: dict[str, tuple[Shading, int]] = {}
        drawables = []
        for item, mesh in zip(placed, kept, strict=True):
            key = item.worn
            if key not in worn:
                shading = shade(item.surface, self._source(maker), item.selection)
                worn[key] = shading, len(worn) + 1
            drawables.append(
                Drawable(
                    mesh,
                    worn[key][0],
                    item.world_from_object,
                    worn[key][1],
                    item.thing,
                    item.node.casts_shadows,
                )
            )
        endless = any(mesh.tile is not None for mesh in kept)
        bounded = any(mesh.tile is None for mesh in kept)
        vertices = (
            (mesh.positions, item.world_from_object)
            for item, mesh in zip(placed, kept, strict=True)
            if mesh.tile is None or not bounded  # planes without end are framed only alone
        )
        view = view_of(scene.camera, models, vertices, aspect, endless=endless)
        lights, left_out = lights_of(scene.lights, models, view.world_from_camera)
        cookies = cookies_of(lights, self._source(maker))
        background = self._background(scene.background, maker)
        shadings = [drawable.shading for drawable in drawables]
        if isinstance(background, Shading):
            shadings.append(background)
        worn_pictures = [picture for shading in shadings for picture in shading.pictures]
        textures = {
            picture.texture.number: picture.texture
            for picture in (*worn_pictures, *cookies.pictures)
        }
        return BuiltScene(
            drawables=tuple(drawables),
            view=view,
            background=background,
            lights=tuple(lights),
            cookies=cookies,
            triangles=sum(len(mesh.elements) for mesh in kept),
            texels=sum(texture.width * texture.height for texture in textures.values()),
            warnings=tuple(
                dict.fromkeys(itertools.chain(*(item.model.warnings for item in models), left_out))
            ),
        )

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._textures.trim()
        self._meshes.trim()

    def _kept(self, item: _Placed, tangents: bool) -> VertexArray:
        wanted = tangents_wanted(item.surface)
        if tangents and wanted is None:
            wanted = TangentsWanted(0, item.surface.tangents)

        def make() -> tuple[VertexArray, int]:
            mesh = item.mesh()
            if wanted is not None:
                mesh = with_tangents(mesh, wanted.uv_set)
            uploaded = VertexArray.upload(mesh)
            return uploaded, uploaded.size_bytes

        return self._meshes.get((item.key, wanted), make)

    def _shading(self, surface: SurfaceSpec, maker: TextureMaker) -> Shading:
        return shade(surface, self._source(maker))

    def _source(self, maker: TextureMaker) -> TextureSource:
        def texture_of(
            spec: TextureSpec,
            meaning: Meaning,
            *,
            levels: bool,
            cut: Cut | None = None,
            preparation: Preparation | None = None,
            form: StoredForm = BOX,
        ) -> Texture:
            cut = cut if levels or form.kind == "ripmap" else None
            form = form if levels or form.is_table else BOX
            key = (spec.model_dump_json(), meaning, levels, cut, preparation, form)
            return self._textures.get(
                key,
                lambda: _upload(prepared(maker(spec, meaning), preparation), levels, cut, form),
            )

        return texture_of

    def _background(
        self, spec: list[float] | ColorMap | None, maker: TextureMaker
    ) -> Background | None:
        if spec is None:
            return None
        if isinstance(spec, ColorMap):
            where = {"coordinates": UvSpec(technique="uv"), "layout": None}
            surface = UnlitSpec(technique="unlit", color=spec.model_copy(update=where))
            return self._shading(surface, maker)
        return tuple(min(value, LARGEST_LIGHT) for value in spec)


def _nodes(nodes: list[Node], world_from_parent: Matrix) -> Iterator[tuple[Node, Matrix]]:
    for node in nodes:
        matrix = world_from_parent @ parent_from_node(node.transform)
        yield node, matrix
        yield from _nodes(node.children, matrix)


def _selected(item: _Placed) -> list[_Placed]:
    """Return a thing once for each of its surfaces."""
    among = item.node.surface_map
    if among is None:
        return [item]
    return [
        replace(item, surface=surface, selection=Selection(among, number))
        for number, surface in enumerate(among.surfaces)
    ]


def _parts(node: Node, mesh: ModelMesh, model: Model, matrix: Matrix) -> Iterator[_Placed]:
    # Keys of parts are a model's own, and one file is another model for each set and scene.
    own = f"{mesh.asset} {sorted(mesh.files.items())} {mesh.scene}"
    for part, worn in seen_parts(mesh, model):
        yield _Placed(
            key=f"{own} {part.key}",
            mesh=partial(_mesh_of, part),
            surface=node.surface or worn or _MATT_GREY,
            world_from_object=matrix @ part.matrix,
            node=node,
        )


def _displaced(item: _Placed, spec: Displacement, maker: TextureMaker) -> _Placed:
    def mesh() -> Mesh:
        return with_relief(item.mesh(), spec, maker(spec.texture, "data"))

    return replace(item, key=f"{item.key} {spec.model_dump_json()}", mesh=mesh)


def _mesh_of(part: Part) -> Mesh:
    return part.mesh


def _upload(image: Image, levels: bool, cut: Cut | None, form: StoredForm) -> tuple[Texture, int]:
    chain = stored(image.pixels, form, levels=levels, cut=cut)
    texture = Texture.upload(chain, image.meaning, (image.width, image.height))
    return texture, texture.size_bytes
