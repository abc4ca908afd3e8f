"""From a request's scene to drawables: nodes placed, meshes and textures uploaded or found."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.coordinates.uv import UvSpec
from api_schemas.environment import Surroundings
from api_schemas.layouts.cube import CubeSpec
from api_schemas.layouts.hemispheres import HemispheresSpec
from api_schemas.lights import Light
from api_schemas.maps import ColorMap
from api_schemas.scene import Scene
from api_schemas.surface_spec import SurfaceSpec
from api_schemas.surfaces.unlit import UnlitSpec
from worker.geometry.transforms import Matrix
from worker.rendering.cookies import Cookies, cookies_of
from worker.rendering.kept_meshes import MeshCache, frames_report
from worker.rendering.placing import ModelReader, Placed, place
from worker.rendering.pyrender_scene import Background, Drawable, View
from worker.rendering.shading import Shading, shade
from worker.rendering.sky import Skies, Sky
from worker.rendering.staging import lights_of, view_of
from worker.rendering.texture_maker import TextureMaker
from worker.rendering.texture_store import TextureStore

TEXTURE_BYTES_MAX = 128 << 20
_UPSIDE_DOWN = (
    "the environment's light comes from below: its picture may be stored upside down, or its "
    "layout be another one"
)
LARGEST_LIGHT = 5e36
"""Of a picture, as in lib/picture.glsl."""


@dataclass(frozen=True, slots=True)
class Mirror:
    """Drawables of one node that see the rest of the scene, and in what picture."""

    numbers: tuple[int, ...]
    spec: Surroundings


@dataclass(frozen=True, slots=True)
class BuiltScene:
    """What a picture is drawn from, and how much of it there is."""

    drawables: tuple[Drawable, ...]
    view: View
    lights: tuple[Light, ...]
    cookies: Cookies
    background: Background | None
    sky: Sky | None
    mirrors: tuple[Mirror, ...]
    triangles: int
    texels: int
    report: dict[str, Any]
    warnings: tuple[str, ...]


class SceneBuilder:
    """Keeps meshes and textures of earlier scenes, by content."""

    def __init__(self) -> None:
        """Begin with nothing in OpenGL."""
        self._textures = TextureStore(TEXTURE_BYTES_MAX)
        self._meshes = MeshCache()
        self._skies = Skies()

    def build(
        self,
        scene: Scene,
        aspect: float,
        maker: TextureMaker,
        reader: ModelReader,
        *,
        tangents: bool = False,
        turns: Sequence[Matrix] = (np.eye(4),),
    ) -> BuiltScene:
        """Place, upload and lay out everything in a scene.

        Args:
            scene: The request's.
            aspect: Width over height of the picture.
            maker: Makes the pictures of textures that are not kept from an earlier scene.
            reader: Reads the uploaded models.
            tangents: Whether all meshes need them, not only those with normal maps.
            turns: How all things will be moved, frame by frame; a camera that frames sees all.

        Raises:
            WorkerError: The camera is degenerate, a budget is exceeded, a texture cannot be made,
                a model cannot be read or has no such part.
        """
        placed, models = place(scene.nodes, maker, reader)
        kept = [self._meshes.get(item, tangents) for item in placed]
        worn: dict[str, tuple[Shading, int]] = {}
        drawables = []
        for item, found in zip(placed, kept, strict=True):
            key = item.worn
            if key not in worn:
                shading = shade(item.surface, self._textures.source(maker), item.selection)
                worn[key] = shading, len(worn) + 1
            drawables.append(
                Drawable(
                    found.mesh,
                    worn[key][0],
                    item.world_from_object,
                    worn[key][1],
                    item.thing,
                    item.node.casts_shadows and not item.surface.fills_box,
                    item.name,
                )
            )
        endless = any(found.mesh.tile is not None for found in kept)
        bounded = any(found.mesh.tile is None for found in kept)
        vertices = (
            (found.mesh.positions, turn @ item.world_from_object)
            for turn in turns
            for item, found in zip(placed, kept, strict=True)
            if found.mesh.tile is None or not bounded  # planes without end are framed only alone
        )
        view = view_of(scene.camera, models, vertices, aspect, endless=endless)
        lights, left_out = lights_of(
            scene.lights,
            models,
            view.world_from_camera,
            surrounded=scene.environment is not None,
        )
        sky = None if scene.environment is None else self._skies.sky(scene.environment, maker)
        cookies = cookies_of(lights, self._textures.source(maker))
        background = self._background(scene.background, maker)
        if background is None and scene.environment is not None and scene.environment.visible:
            background = sky
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
            sky=sky,
            mirrors=_mirrors(placed),
            lights=tuple(lights),
            cookies=cookies,
            triangles=sum(len(found.mesh.elements) for found in kept),
            texels=sum(texture.width * texture.height for texture in textures.values()),
            report=frames_report(placed, kept),
            warnings=tuple(
                dict.fromkeys(
                    itertools.chain(
                        *(item.model.warnings for item in models),
                        left_out,
                        [_UPSIDE_DOWN] if sky is not None and sky.from_below else [],
                    )
                )
            ),
        )

    def rendered_sky(
        self, picture: NDArray[np.float32], layout: CubeSpec | HemispheresSpec, maker: TextureMaker
    ) -> Sky:
        """Return the sky of a picture (height, width, 3) of a scene."""
        return self._skies.rendered_sky(picture, layout, maker)

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._textures.trim()
        self._meshes.trim()
        self._skies.trim()

    def _shading(self, surface: SurfaceSpec, maker: TextureMaker) -> Shading:
        return shade(surface, self._textures.source(maker))

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


def _mirrors(placed: list[Placed]) -> tuple[Mirror, ...]:
    numbers: dict[int, list[int]] = {}
    for number, item in enumerate(placed):
        if item.node.surroundings is not None:
            numbers.setdefault(id(item.node), []).append(number)
    found = []
    for of_node in numbers.values():
        spec = placed[of_node[0]].node.surroundings
        assert spec is not None
        found.append(Mirror(tuple(of_node), spec))
    return tuple(found)
