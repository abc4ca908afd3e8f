"""From a request's scene to drawables: nodes placed, meshes and textures uploaded or found."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from api_schemas import meshes
from api_schemas.camera import OrthographicCamera
from api_schemas.families import Meaning, SurfaceSpec, TextureSpec
from api_schemas.scene import Node, Scene
from api_schemas.surfaces.phong import PhongSpec
from worker.geometry import primitives
from worker.geometry.transforms import (
    Matrix,
    clip_from_camera,
    parent_from_node,
    world_from_camera,
)
from worker.images.image import Image
from worker.images.pyramids import mip_chain
from worker.rendering.cache import ByteCache
from worker.rendering.pyrender_adapter import Drawable, UploadedMesh, View, delete_mesh, upload_mesh
from worker.rendering.shading import shade
from worker.rendering.textures import Texture

TEXTURE_BYTES_MAX = 128 << 20
MESH_BYTES_MAX = 64 << 20
_MATT_GREY = PhongSpec(technique="phong")


class TextureMaker(Protocol):
    """Turns a texture of the language into a picture."""

    def __call__(self, spec: TextureSpec, meaning: Meaning, /) -> Image:
        """Return the picture, read as colour or as data."""


@dataclass(frozen=True, slots=True)
class BuiltScene:
    """What a picture is drawn from, and how much of it there is."""

    drawables: tuple[Drawable, ...]
    view: View
    triangles: int
    texels: int


class SceneBuilder:
    """Keeps meshes and textures of earlier scenes, by content."""

    def __init__(self) -> None:
        """Begin with nothing in OpenGL."""
        self._textures = ByteCache[Texture](TEXTURE_BYTES_MAX, Texture.delete)
        self._meshes = ByteCache[UploadedMesh](MESH_BYTES_MAX, delete_mesh)

    def build(self, scene: Scene, aspect: float, maker: TextureMaker) -> BuiltScene:
        """Place, upload and lay out everything in a scene.

        Args:
            scene: The request's.
            aspect: Width over height of the picture.
            maker: Makes the pictures of textures that are not kept from an earlier scene.

        Raises:
            WorkerError: The camera is degenerate, a budget is exceeded, a texture cannot be made.
        """
        view = View(
            world_from_camera=world_from_camera(scene.camera.pose),
            clip_from_camera=clip_from_camera(scene.camera, aspect),
            orthographic=isinstance(scene.camera, OrthographicCamera),
        )
        drawables = []
        materials: dict[str, int] = {}
        triangles = 0
        for node, matrix in _placed(scene.nodes, np.eye(4)):
            if node.mesh is not None:
                surface = node.surface or _MATT_GREY
                number = materials.setdefault(surface.model_dump_json(), len(materials) + 1)
                drawables.append(self._drawable(node.mesh, surface, number, matrix, maker))
                triangles += node.mesh.triangles
        pictures = {
            picture.texture.number: picture.texture
            for drawable in drawables
            for picture in drawable.shading.pictures
        }
        return BuiltScene(
            drawables=tuple(drawables),
            view=view,
            triangles=triangles,
            texels=sum(texture.width * texture.height for texture in pictures.values()),
        )

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._textures.trim()
        self._meshes.trim()

    def _drawable(
        self,
        mesh: meshes.Mesh,
        surface: SurfaceSpec,
        number: int,
        matrix: Matrix,
        maker: TextureMaker,
    ) -> Drawable:
        def texture_of(spec: TextureSpec, meaning: Meaning, *, levels: bool) -> Texture:
            key = (spec.model_dump_json(), meaning, levels)
            return self._textures.get(key, lambda: _upload(maker(spec, meaning), levels))

        return Drawable(
            primitive=self._meshes.get(mesh.model_dump_json(), lambda: _mesh(mesh)),
            shading=shade(surface, texture_of),
            world_from_object=matrix,
            material=number,
        )


def _placed(nodes: list[Node], world_from_parent: Matrix) -> Iterator[tuple[Node, Matrix]]:
    for node in nodes:
        matrix = world_from_parent @ parent_from_node(node.transform)
        yield node, matrix
        yield from _placed(node.children, matrix)


def _mesh(spec: meshes.Mesh) -> tuple[UploadedMesh, int]:
    mesh = primitives.build(spec)
    return upload_mesh(mesh), mesh.size_bytes


def _upload(image: Image, levels: bool) -> tuple[Texture, int]:
    chain = mip_chain(image.pixels) if levels else [image.pixels]
    texture = Texture.upload(chain, image.meaning)
    return texture, texture.size_bytes
