"""What a tile is drawn with, and the programs that are lit once for each."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from worker.rendering.gl_context import GL
from worker.rendering.infinite_planes import plane_uniforms, whole_target
from worker.rendering.lighting import Lighting
from worker.rendering.programs import Program
from worker.rendering.pyrender_scene import FlatScene, SurfacePrimitive
from worker.rendering.targets import Target

_SET_BY_PYRENDER = frozenset({"V", "P", "cam_pos"})


@dataclass(slots=True)
class TraversedProgram(Program):
    """A program as pyrender's traversal handles it; `frame` is the last one that it was lit for."""

    frame: int = 0

    def _bind(self) -> None:
        self.bind()

    def _unbind(self) -> None:
        GL.glUseProgram(0)

    def set_uniform(self, name: str, value: Any) -> None:
        """Take pyrender's camera uniforms; we set our own, in float64 until the last step."""
        if name not in _SET_BY_PYRENDER:
            self.set(name, value)


@dataclass(slots=True)
class Frame:
    """What one tile is drawn with.

    Attributes:
        number: Which frame of this renderer it is, from 1.
        scene: What is drawn.
        lights: What shines on it.
        target: Where the samples go.
        clip_from_object: (n, 4, 4), by the number of the drawable.
        size: Of the tile in samples.
        corner: Of the tile in the picture, in samples from the lower left.
        picture: Width and height of the whole picture in pixels.
        supersampling: Samples along each side of a pixel.
        tile_from_picture: Stretches the tile's part of clip space over all of it.
        blending: Whether what is drawn now lets light through.
    """

    number: int
    scene: FlatScene
    lights: Lighting
    target: Target
    clip_from_object: NDArray[np.float64]
    size: NDArray[np.int64]
    corner: NDArray[np.float64]
    picture: NDArray[np.float64]
    supersampling: int
    tile_from_picture: NDArray[np.float64]
    blending: bool

    def place(self, program: Program, primitive: SurfacePrimitive) -> None:
        """Tell the bound program where a primitive lies in the tile and stands to the eye."""
        clip_from_object = self.clip_from_object[primitive.number]
        tile = primitive.mesh.tile
        if tile is not None and primitive.hidden:
            eye_from_object = self.scene.world_from_object[primitive.number].copy()
            eye_from_object[:3, 3] -= self.scene.view.world_from_camera[:3, 3]
            places = plane_uniforms(tile, clip_from_object, eye_from_object, self.size)
            for name, value in places.items():
                program.set(name, value)
            clip_from_object = whole_target(tile)
        program.set("clip_from_object", clip_from_object)
        self.scene.place(program, primitive)
