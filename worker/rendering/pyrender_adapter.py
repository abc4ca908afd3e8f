"""pyrender's Renderer with our programs, our float targets and our uniforms.

Of pyrender remain the scene, the traversal and the contexts. Overridden are its private hooks,
which a pinned version and a test keep where they are. Not used are its shaders, which clamp and
encode, its textures, which truncate floats, its vertex buffers, whose attributes move, and its
lights.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
import pyrender
from numpy.typing import NDArray
from pyrender.constants import RenderFlags

from worker.geometry.mesh import Mesh
from worker.geometry.transforms import Matrix, normal_matrix, rigid_inverse
from worker.rendering.fragment import surface_sources
from worker.rendering.gl_context import GL, GLContext, check
from worker.rendering.programs import Program, ProgramCache
from worker.rendering.samplers import SamplerCache
from worker.rendering.shading import Shading
from worker.rendering.targets import Target
from worker.rendering.vertex_arrays import VertexArray

UploadedMesh: TypeAlias = VertexArray
"""A mesh in OpenGL."""

_SET_BY_PYRENDER = frozenset({"V", "P", "cam_pos"})


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


@dataclass(frozen=True, slots=True)
class Drawable:
    """A mesh in OpenGL, a surface, and where they stand."""

    mesh: UploadedMesh
    shading: Shading
    world_from_object: Matrix


class SurfaceMaterial(pyrender.Material):  # type: ignore[misc]
    """Carries a shading through pyrender's traversal. Textures are ours to upload and to free."""

    def __init__(self, shading: Shading) -> None:
        """Make a material that draws both sides of a surface."""
        super().__init__(doubleSided=True)
        self.shading = shading

    @property
    def textures(self) -> set[Any]:
        """Tell pyrender of no textures."""
        return set()


class SurfacePrimitive(pyrender.Primitive):  # type: ignore[misc]
    """Carries a mesh and its surface through pyrender's traversal."""

    def __init__(self, mesh: UploadedMesh, shading: Shading) -> None:
        """Take what is drawn; pyrender itself learns of no vertices."""
        super().__init__(positions=np.empty((0, 3)), material=SurfaceMaterial(shading))
        self.mesh = mesh


class PlacedNode(pyrender.Node):  # type: ignore[misc]
    """A node with any matrix; pyrender's own would break mirrored, sheared and flat ones up."""

    def __init__(self, matrix: Matrix, order: int, **content: Any) -> None:
        """Place a mesh or a camera; `order` is its place in the request."""
        super().__init__(**content)
        self._matrix = matrix
        self.order = order


class MatrixCamera(pyrender.Camera):  # type: ignore[misc]
    """A camera whose projection is known already."""

    def __init__(self, clip_from_camera: Matrix) -> None:
        """Take a projection."""
        super().__init__()
        self._clip_from_camera = clip_from_camera

    def get_projection_matrix(self, width: int | None = None, height: int | None = None) -> Matrix:
        """Return the projection, whatever the size of the tile."""
        return self._clip_from_camera


def upload_mesh(mesh: Mesh) -> UploadedMesh:
    """Copy a mesh to OpenGL, at the attribute locations of mesh.vert."""
    return VertexArray.upload(mesh)


def delete_mesh(mesh: UploadedMesh) -> None:
    """Free a mesh's buffers."""
    mesh.delete()


def pyrender_scene(drawables: Sequence[Drawable], view: View) -> "pyrender.Scene":
    """Put drawables and the eye into a scene of pyrender's."""
    scene = pyrender.Scene(bg_color=np.zeros(4), ambient_light=np.zeros(3))
    camera = MatrixCamera(view.clip_from_camera)
    scene.add_node(PlacedNode(view.world_from_camera, -1, camera=camera))
    for order, drawable in enumerate(drawables):
        mesh = pyrender.Mesh([SurfacePrimitive(drawable.mesh, drawable.shading)])
        scene.add_node(PlacedNode(drawable.world_from_object, order, mesh=mesh))
    return scene


class _TraversedProgram(Program):
    """A program as pyrender's traversal handles it."""

    __slots__ = ()

    def _bind(self) -> None:
        self.bind()

    def _unbind(self) -> None:
        GL.glUseProgram(0)

    def set_uniform(self, name: str, value: Any) -> None:
        """Take pyrender's camera uniforms; we set our own, in float64 until the last step."""
        if name not in _SET_BY_PYRENDER:
            self.set(name, value)


@dataclass(slots=True)
class _Frame:
    """What one tile is drawn with."""

    view: View
    lights: dict[str, Any]
    target: Target
    clip_from_world: Matrix
    eye_from_world: Matrix
    eye: NDArray[np.float64] = field(default_factory=lambda: np.array([0.0, 0.0, 0.0, 1.0]))


class FloatRenderer(pyrender.Renderer):  # type: ignore[misc]
    """Draws scenes into float32 targets.

    Attributes:
        jit_seconds: Time spent so far in linking programs and in their first draws.
    """

    def __init__(self, context: GLContext) -> None:
        """Prepare to draw in an open context."""
        super().__init__(1, 1)
        self._context = context
        self._programs = ProgramCache(_TraversedProgram)
        self._samplers = SamplerCache()
        self._frame: _Frame | None = None
        self.jit_seconds = 0.0

    def draw(
        self,
        scene: "pyrender.Scene",
        view: View,
        lights: dict[str, Any],
        target: Target,
        tile_from_picture: Matrix,
        size: tuple[int, int],
        supersampling: int,
    ) -> None:
        """Draw one tile into the lower left part of a target; where nothing is, all four are 0.

        Args:
            scene: From pyrender_scene.
            view: The same eye.
            lights: From light_uniforms.
            target: Where the samples go.
            tile_from_picture: Stretches the tile's part of clip space over all of it.
            size: The tile's width and height in samples.
            supersampling: Samples along each side of a pixel: how wide lines and points are.

        Raises:
            RenderError: OpenGL complains, or this is not the context's thread.
        """
        self._context.check_thread()
        camera_from_world = rigid_inverse(view.world_from_camera)
        eye_from_world = np.eye(4)
        eye_from_world[:3, 3] = -view.world_from_camera[:3, 3]
        frame = _Frame(
            view=view,
            lights=lights,
            target=target,
            clip_from_world=tile_from_picture @ view.clip_from_camera @ camera_from_world,
            eye_from_world=eye_from_world,
        )
        if view.orthographic:
            frame.eye = np.append(view.world_from_camera[:3, 2], 0.0)
        self._frame = frame
        self.viewport_width, self.viewport_height = size
        GL.glLineWidth(supersampling)
        GL.glPointSize(supersampling)
        self.render(scene, RenderFlags.OFFSCREEN)
        check("drawing a tile")

    # Hooks of pyrender.Renderer, in the order in which its traversal calls them.

    def _update_context(self, scene: Any, flags: int) -> None:
        """Leave meshes and textures alone: caches that outlive the scene own them."""

    def _configure_forward_pass_viewport(self, flags: int) -> None:
        assert self._frame is not None
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._frame.target.framebuffer)
        GL.glViewport(0, 0, self.viewport_width, self.viewport_height)
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(True)
        GL.glDepthFunc(GL.GL_GREATER)
        GL.glClearDepth(0.0)
        GL.glDisable(GL.GL_BLEND)
        GL.glEnable(GL.GL_CULL_FACE)

    def _get_camera_matrices(self, scene: Any) -> tuple[Matrix, Matrix]:
        assert self._frame is not None
        return self._frame.eye_from_world, self._frame.clip_from_world

    def _sorted_mesh_nodes(self, scene: Any) -> list[PlacedNode]:
        """Near to far, then as the request has them: pyrender's own order hangs on a set's."""
        assert self._frame is not None
        eye = self._frame.view.world_from_camera[:3, 3]
        return sorted(
            scene.mesh_nodes,
            key=lambda node: (float(np.linalg.norm(node.matrix[:3, 3] - eye)), node.order),
        )

    def _get_primitive_program(self, primitive: Any, flags: int, program_flags: int) -> Program:
        layout = primitive.material.shading.layout
        start = time.perf_counter()
        program = self._programs.get(layout, lambda: surface_sources(layout))
        if not program.drawn:
            self.jit_seconds += time.perf_counter() - start
        return program

    def _bind_lighting(self, scene: Any, program: Program, node: Any, flags: int) -> None:
        assert self._frame is not None
        if "light_count" in program.uniforms:
            for name, value in self._frame.lights.items():
                program.set(name, value)

    def _bind_and_draw_primitive(
        self, primitive: Any, pose: Matrix, program: Program, flags: int
    ) -> None:
        assert self._frame is not None
        frame = self._frame
        program.set("eye", frame.eye)
        program.set("clip_from_object", frame.clip_from_world @ pose)
        program.set("eye_from_object", frame.eye_from_world @ pose)
        program.set("normal_from_object", normal_matrix(pose))
        mirrored = np.linalg.det(pose[:3, :3]) < 0
        program.set("handedness", -1.0 if mirrored else 1.0)
        shading: Shading = primitive.material.shading
        for name, value in shading.uniforms.items():
            program.set(name, value)
        for unit, picture in enumerate(shading.pictures):
            GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
            GL.glBindTexture(GL.GL_TEXTURE_2D, picture.texture.number)
            GL.glBindSampler(unit, self._samplers.get(picture.sampling, picture.border))
            program.set(f"picture_{unit}", unit)
        mesh: UploadedMesh = primitive.mesh
        start = time.perf_counter()
        mesh.bind()
        # A mirrored transform turns the winding, but not which side is the outer one.
        GL.glFrontFace(GL.GL_CW if mirrored else GL.GL_CCW)
        # Outer sides first: the depth test then spares the shading of inner sides behind them.
        for hidden in (GL.GL_BACK, GL.GL_FRONT) if mesh.has_sides else (GL.GL_BACK,):
            GL.glCullFace(hidden)
            mesh.draw()
        GL.glBindVertexArray(0)
        if not program.drawn:
            program.drawn = True
            self.jit_seconds += time.perf_counter() - start

    def _read_main_framebuffer(self, scene: Any, flags: int) -> None:
        """Read nothing: the tile is resolved first."""

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._programs.trim()
        self._samplers.trim()

    def delete(self) -> None:
        """Free programs and samplers."""
        self._programs.delete()
        self._samplers.delete()
