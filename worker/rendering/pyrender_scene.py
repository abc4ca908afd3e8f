"""A scene as pyrender's traversal takes it: what is drawn, where it stands, and in which order."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import pyrender
from numpy.typing import NDArray

from worker.geometry.transforms import Matrix, normal_matrix
from worker.rendering.draw_order import back_to_front, nearness
from worker.rendering.gl_context import GL, floats
from worker.rendering.infinite_planes import eye_side
from worker.rendering.programs import Program
from worker.rendering.shading import Shading
from worker.rendering.sky import Sky
from worker.rendering.vertex_arrays import VertexArray

_FINE = 1 << 17
"""Triangles of a mesh beyond which going through it twice costs more than shading what is hidden:
0.7 s and 0.4 s for a million of them at 512 x 512, on a busy machine."""

_RANKS = {"opaque": 0, "mask": 1, "blend": 2}


@dataclass(frozen=True, slots=True)
class View:
    """The eye.

    Attributes:
        world_from_camera: Where it stands; a rigid motion.
        clip_from_camera: Its projection, with reversed depth.
        orthographic: Whether all views are parallel.
    """

    world_from_camera: Matrix
    clip_from_camera: Matrix
    orthographic: bool

    def rays(self, tile_from_picture: Matrix) -> dict[str, NDArray[np.float64]]:
        """Return where the eye looks, as lib/sky_background.glsl wants it.

        Through a tile's middle, and from there to right and top. The directions through other
        places add up. With parallel views there is but one.
        """
        axes = self.world_from_camera[:3, :3]
        if self.orthographic:
            none = np.zeros(3)
            return {"ray_middle": -axes[:, 2], "ray_across": none, "ray_up": none}
        clip_from_ray = (tile_from_picture @ self.clip_from_camera)[[0, 1, 3], :3]
        rays = (axes @ np.linalg.inv(clip_from_ray)).T
        return dict(zip(("ray_across", "ray_up", "ray_middle"), rays, strict=True))


@dataclass(frozen=True, slots=True)
class Drawable:
    """A mesh in OpenGL, a surface, and where they stand.

    Attributes:
        mesh: What is drawn.
        shading: How.
        world_from_object: Where.
        material: The number of the surface, from 1.
        thing: The number of what it is or is a part of, from 1.
        casts_shadows: Whether it keeps light away.
        name: What people call it.
        sky: Light from all around that is its own.
    """

    mesh: VertexArray
    shading: Shading
    world_from_object: Matrix
    material: int
    thing: int
    casts_shadows: bool
    name: str
    sky: Sky | None = None

    def corners(self) -> NDArray[np.float64]:
        """Give the corners of a box that holds it: (8, 3) in the world."""
        local = np.stack(np.meshgrid(*self.mesh.bounds.T), axis=-1).reshape(-1, 3)
        matrix = self.world_from_object
        corners: NDArray[np.float64] = local @ matrix[:3, :3].T + matrix[:3, 3]
        return corners


Background: TypeAlias = Shading | Sky | tuple[float, ...]
"""What is seen where nothing is: a mapped colour over the whole picture, the environment, or a
linear colour."""


class SurfaceMaterial(pyrender.Material):  # type: ignore[misc]
    """Carries a shading through pyrender's traversal. Textures are ours to upload and to free."""

    def __init__(self, shading: Shading, number: int) -> None:
        """Make a material of a shading; `number` is its material id."""
        super().__init__(doubleSided=shading.double_sided)
        self.shading = shading
        self.number = number

    @property
    def textures(self) -> set[Any]:
        """Tell pyrender of no textures."""
        return set()


class SurfacePrimitive(pyrender.Primitive):  # type: ignore[misc]
    """Carries a mesh, its surface and how they are drawn through pyrender's traversal.

    Attributes:
        mesh: What is drawn.
        number: Its place among the drawables.
        thing: Its object id.
        mirrored: Whether its transform turns the winding of triangles.
        clockwise: Whether the outer sides of triangles are wound clockwise on the screen.
        hidden: Which sides are left out in each pass: outer, inner, or none (None).
        elements: Its triangles, lines or points from back to front, where that matters.
    """

    hidden: tuple[int | None, ...]
    elements: NDArray[np.uint32] | None

    def __init__(self, drawable: Drawable, number: int, view: View, *, mirrored: bool) -> None:
        """Take what is drawn; pyrender itself learns of no vertices."""
        material = SurfaceMaterial(drawable.shading, drawable.material)
        super().__init__(positions=_NO_VERTICES, material=material)
        self.mesh = drawable.mesh
        self.number = number
        self.thing = drawable.thing
        self.mirrored = mirrored
        self.clockwise = mirrored
        self.hidden = (GL.GL_BACK,)
        self.elements = None
        blended = drawable.shading.layout.alpha_mode == "blend"
        both = drawable.shading.double_sided
        if not blended:
            # Outer sides first: the depth test then spares the shading of inner ones behind them.
            if both and self.mesh.has_sides:
                fine = len(self.mesh.elements) > _FINE
                self.hidden = (None,) if fine else (GL.GL_BACK, GL.GL_FRONT)
        elif self.mesh.convex:
            if both:
                self.hidden = (GL.GL_FRONT, GL.GL_BACK)
        else:
            if both:
                self.hidden = (None,)
            towards_eye = drawable.world_from_object[:3, :3].T @ view.world_from_camera[:3, 2]
            self.elements = back_to_front(self.mesh.positions, self.mesh.elements, towards_eye)
        if self.mesh.tile is not None:
            side = eye_side(
                self.mesh.tile,
                drawable.world_from_object,
                view.world_from_camera,
                orthographic=view.orthographic,
            )
            self.clockwise = side < 0
            self.hidden = self.hidden if side else ()


class PlacedNode(pyrender.Node):  # type: ignore[misc]
    """A node with any matrix; pyrender's own would break mirrored, sheared and flat ones up."""

    def __init__(self, matrix: Matrix, **content: Any) -> None:
        """Place a mesh or a camera."""
        super().__init__(**content)
        self._matrix = matrix


class MatrixCamera(pyrender.Camera):  # type: ignore[misc]
    """A camera whose projection is known already."""

    def __init__(self, clip_from_camera: Matrix) -> None:
        """Take a projection."""
        super().__init__()
        self._clip_from_camera = clip_from_camera

    def get_projection_matrix(self, width: int | None = None, height: int | None = None) -> Matrix:
        """Return the projection, whatever the size of the tile."""
        return self._clip_from_camera


class FlatScene(pyrender.Scene):  # type: ignore[misc]
    """A scene whose nodes all stand in the world.

    Attributes:
        background: What is behind everything.
        sky: The light from all around, if there is any but the even one.
        view: The eye.
        in_order: Its nodes as they are drawn.
        casters: Those that keep light away.
        eye: As lib/fragment.glsl wants it.
        world_from_object: (n, 4, 4), by the number of the drawable.
        eye_from_object: float32 (n, 4, 4), axes of the world and origin at the eye.
        normal_from_object: float32 (n, 3, 3).
    """

    def __init__(
        self,
        drawables: Sequence[Drawable],
        view: View,
        background: Background | None,
        sky: Sky | None,
    ) -> None:
        """Put drawables and the eye into a scene of pyrender's."""
        super().__init__(bg_color=np.zeros(4), ambient_light=np.zeros(3))
        self._drawables = drawables
        self.background = background
        self.sky = sky
        self.view = view
        camera = MatrixCamera(view.clip_from_camera)
        self.add_node(PlacedNode(view.world_from_camera, camera=camera))
        matrices = np.array([drawable.world_from_object for drawable in drawables])
        matrices = matrices.reshape(-1, 4, 4)
        eye_from_object = matrices.copy()
        eye_from_object[:, :3, 3] -= view.world_from_camera[:3, 3]
        backward = view.world_from_camera[:3, 2]
        self.eye = np.append(backward, 0.0) if view.orthographic else np.array([0.0, 0.0, 0.0, 1.0])
        self.world_from_object = matrices
        self.eye_from_object = floats(eye_from_object)
        self.normal_from_object = floats(normal_matrix(matrices))
        nodes = []
        for number, mirrored in enumerate(np.linalg.det(matrices[:, :3, :3]) < 0):
            primitive = SurfacePrimitive(drawables[number], number, view, mirrored=bool(mirrored))
            nodes.append(PlacedNode(matrices[number], mesh=pyrender.Mesh([primitive])))
            self.add_node(nodes[-1])
        order = _drawing_order(drawables, view)
        self.in_order = [nodes[number] for number in order]
        self.casters = [nodes[number] for number in order if drawables[number].casts_shadows]

    def corners(self) -> NDArray[np.float64]:
        """Give the corners of boxes that hold all that has an end: (n, 3) in the world."""
        ended = (drawable for drawable in self._drawables if drawable.mesh.tile is None)
        boxes = [drawable.corners() for drawable in ended]
        return np.concatenate([np.empty((0, 3)), *boxes])

    def sky_of(self, primitive: SurfacePrimitive) -> Sky | None:
        """Return the light from all around that a primitive gets."""
        return self._drawables[primitive.number].sky or self.sky

    def place(self, program: Program, primitive: SurfacePrimitive) -> None:
        """Tell the bound program where a primitive stands to the eye."""
        program.set("eye", self.eye)
        if "eye_position" in program.uniforms:
            program.set("eye_position", self.view.world_from_camera[:3, 3])
            program.set("camera_from_world", self.view.world_from_camera[:3, :3].T)
        program.set("eye_from_object", self.eye_from_object[primitive.number])
        program.set("normal_from_object", self.normal_from_object[primitive.number])
        program.set("handedness", -1.0 if primitive.mirrored else 1.0)
        if "box_low" in program.uniforms:
            low, high = primitive.mesh.bounds
            program.set("box_low", low)
            program.set("box_high", high)

    def get_pose(self, node: PlacedNode) -> Matrix:
        """Return where a node stands, without a search for its parents."""
        matrix: Matrix = node.matrix
        return matrix


_NO_VERTICES = np.empty((0, 3), dtype=np.float32)


def _drawing_order(drawables: Sequence[Drawable], view: View) -> list[int]:
    """What hides comes first, near to far; then what lets light through, far to near."""
    middles = [d.world_from_object @ np.append(d.mesh.centre, 1.0) for d in drawables]
    near = nearness(np.array(middles).reshape(-1, 4)[:, :3], view.world_from_camera)
    ranks = np.array([_RANKS[d.shading.layout.alpha_mode] for d in drawables], dtype=int)
    order = np.lexsort((np.where(ranks == _RANKS["blend"], near, -near), ranks))
    return [int(number) for number in order]
