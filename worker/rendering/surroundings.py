"""A scene as one of its things sees it: six pictures of a quarter turn each (T23).

Two hemispheres are read from them: no projection by a matrix has a half sphere's round rim, and
triangles would need curved edges.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from api_schemas.layouts.cube import CubeSpec
from api_schemas.layouts.hemispheres import HemispheresSpec
from api_schemas.sky import SKY_CUBE, SKY_LAYOUTS
from worker import layouts
from worker.geometry.transforms import Matrix, perspective
from worker.rendering.lighting import lighting
from worker.rendering.pyrender_adapter import FloatRenderer
from worker.rendering.pyrender_scene import Drawable, FlatScene, View
from worker.rendering.scene_builder import BuiltScene, SceneBuilder
from worker.rendering.targets import TargetPair
from worker.rendering.texture_maker import TextureMaker

_SUPERSAMPLING = 2
_NEAREST = 1e-3  # of a thing's size; what is nearer to its middle is not seen
_FARTHEST = 1e7  # of the nearest

# Right, up and backward of an eye that looks along +x, -x, +y, -y, +z, -z. What it sees is an
# OpenGL face that is mirrored.
_AXES = np.array(
    [
        [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
        [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
        [[-1, 0, 0], [0, 0, -1], [0, -1, 0]],
        [[-1, 0, 0], [0, 0, 1], [0, 1, 0]],
        [[-1, 0, 0], [0, 1, 0], [0, 0, -1]],
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ],
    dtype=np.float64,
)


def with_surroundings(
    built: BuiltScene,
    renderer: FloatRenderer,
    targets: TargetPair,
    builder: SceneBuilder,
    maker: TextureMaker,
) -> BuiltScene:
    """Give each thing that mirrors the scene a sky of its own: all the others as it sees them.

    In that picture the others mirror the scene's environment only: light bounces once.

    Raises:
        WorkerError: OpenGL complains, or a texture cannot be made.
    """
    drawables = list(built.drawables)
    for mirror in built.mirrors:
        own = set(mirror.numbers)
        others = [d for number, d in enumerate(built.drawables) if number not in own]
        itself = [built.drawables[number] for number in mirror.numbers]
        side, layout = mirror.spec.side, SKY_LAYOUTS[mirror.spec.layout]
        faces = _look_around(built, others, itself, renderer, targets, side)
        seen = faces if isinstance(layout, CubeSpec) else _discs(faces, layout)
        sky = builder.rendered_sky(seen.reshape(-1, seen.shape[-2], 3), layout, maker)
        for number in mirror.numbers:
            drawables[number] = replace(drawables[number], sky=sky)
    return replace(built, drawables=tuple(drawables))


def _look_around(
    built: BuiltScene,
    others: Sequence[Drawable],
    own: Sequence[Drawable],
    renderer: FloatRenderer,
    targets: TargetPair,
    side: int,
) -> NDArray[np.float32]:
    """Return faces (6, side, side, 3) as CubeTexture has them."""
    corners = np.concatenate([drawable.corners() for drawable in own])
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle, size = (low + high) / 2, float(np.linalg.norm(high - low))
    near = max(_NEAREST * size, 1e-6)
    background = built.sky or (built.background if isinstance(built.background, tuple) else None)
    faces = np.empty((6, side, side, 3), np.float32)
    everything = FlatScene(built.drawables, built.view, None, built.sky)
    lights = lighting(built.lights, middle, built.cookies, everything.corners)
    renderer.draw_shadows(everything, lights)
    for face, axes in enumerate(_AXES):
        view = View(
            _pose(axes, middle),
            perspective(math.pi / 2, 1.0, near, _FARTHEST * near),
            orthographic=False,
        )
        target = targets.fit(side, side, _SUPERSAMPLING, layered=False)
        scene = FlatScene(others, view, background, built.sky)
        samples = (side * _SUPERSAMPLING,) * 2
        renderer.draw(scene, lights, target, np.eye(4), samples, _SUPERSAMPLING)
        seen = targets.resolve(side, side, _SUPERSAMPLING).read(0, side, side)
        faces[face] = seen[:, ::-1, :3]
    return faces


def _discs(faces: NDArray[np.float32], layout: HemispheresSpec) -> NDArray[np.float32]:
    """Return discs (2 side, 4 side, 3), blended from faces (6, side, side, 3)."""
    side = 2 * faces.shape[1]
    towards, _ = layouts.direction(layout, layouts.texel_middles(2 * side, side))
    largest = np.abs(towards).argmax(axis=1)
    face = 2 * largest + (towards[np.arange(len(towards)), largest] < 0)
    # Along a column nothing lies left or right of a face, along a row nothing above or below.
    row = SKY_CUBE.model_copy(update={"arrangement": "row"})
    u, v = layouts.place(SKY_CUBE, towards)[:, 0], layouts.place(row, towards)[:, 1]
    last = faces.shape[1] - 1
    across, down = (np.clip(at * (last + 1) - 0.5, 0, last) for at in (u, 1 - v))
    left, top = across.astype(np.int64), down.astype(np.int64)
    right, below = np.minimum(left + 1, last), np.minimum(top + 1, last)
    shares = (across - left)[:, np.newaxis], (down - top)[:, np.newaxis]
    upper = faces[face, top, left] * (1 - shares[0]) + faces[face, top, right] * shares[0]
    lower = faces[face, below, left] * (1 - shares[0]) + faces[face, below, right] * shares[0]
    blended: NDArray[np.float32] = (upper * (1 - shares[1]) + lower * shares[1]).astype(np.float32)
    return blended.reshape(side, 2 * side, 3)


def _pose(axes: NDArray[np.float64], middle: NDArray[np.float64]) -> Matrix:
    pose = np.eye(4)
    pose[:3, :3] = axes.T
    pose[:3, 3] = middle
    return pose
