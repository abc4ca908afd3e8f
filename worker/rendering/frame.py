"""What a tile is drawn with, and the programs that are lit once for each."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from worker.rendering.gl_context import GL
from worker.rendering.lookups import Picture
from worker.rendering.programs import Program
from worker.rendering.pyrender_scene import FlatScene
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
        lights: Uniforms.
        target: Where the samples go.
        clip_from_object: (n, 4, 4), by the number of the drawable.
        eye: As lib/fragment.glsl wants it.
        size: Of the tile in samples.
        corner: Of the tile in the picture, in samples from the lower left.
        picture: Width and height of the whole picture in pixels.
        supersampling: Samples along each side of a pixel.
        blending: Whether what is drawn now lets light through.
        bound: What each texture unit holds.
    """

    number: int
    scene: FlatScene
    lights: dict[str, Any]
    target: Target
    clip_from_object: NDArray[np.float64]
    eye: NDArray[np.float64]
    size: NDArray[np.int64]
    corner: NDArray[np.float64]
    picture: NDArray[np.float64]
    supersampling: int
    blending: bool
    bound: dict[int, Picture]
