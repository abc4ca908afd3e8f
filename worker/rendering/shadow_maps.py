"""The depth textures that lights see, one array for all, and the pass that draws them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyrender
from numpy.typing import NDArray
from pyrender.constants import RenderFlags

from worker.errors import RenderError
from worker.geometry.transforms import Matrix
from worker.rendering.chunks import Source, chunk, join
from worker.rendering.fragment import VERSION, hole_sources
from worker.rendering.frame import TraversedProgram
from worker.rendering.gl_context import GL, check, floats
from worker.rendering.light_views import LightView
from worker.rendering.programs import Program, ProgramCache
from worker.rendering.pyrender_scene import FlatScene, PlacedNode, SurfacePrimitive
from worker.rendering.texture_units import SHADOW_UNIT, TextureUnits

_NOTHING = f"{VERSION}\nvoid main() {{}}\n"


@dataclass(frozen=True, slots=True)
class _Pass:
    """One map that is being drawn; clip_from_object by the number of the drawable."""

    scene: FlatScene
    clip_from_object: NDArray[np.float32]


class ShadowMaps(pyrender.Renderer):  # type: ignore[misc]
    """Draws what lights see into layers of one depth texture array.

    A second renderer of pyrender's: the traversal is the same, targets and programs are others.
    """

    def __init__(self, units: TextureUnits) -> None:
        """Begin with no texture; `units` binds the pictures of what is cut out."""
        super().__init__(1, 1)
        self._units = units
        self._programs = ProgramCache(TraversedProgram)
        self._framebuffer = 0
        self._texture = 0
        self._size = (0, 0)  # texels along a side, layers
        self._pass: _Pass | None = None

    def draw_views(self, scene: FlatScene, views: Sequence[LightView]) -> None:
        """Draw all maps of a scene, in the order of the views and their faces.

        Raises:
            RenderError: OpenGL has no room, or complains.
        """
        self._fit(max(view.resolution for view in views), sum(view.faces for view in views))
        self._units.forget()
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._framebuffer)
        GL.glEnable(GL.GL_SCISSOR_TEST)
        faces = ((view, face) for view in views for face in range(view.faces))
        for layer, (view, face) in enumerate(faces):
            GL.glFramebufferTextureLayer(
                GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, self._texture, 0, layer
            )
            self.viewport_width = self.viewport_height = view.resolution
            clip_from_object = view.clip_from_world(face) @ scene.world_from_object
            self._pass = _Pass(scene, floats(clip_from_object))
            self.render(scene, RenderFlags.OFFSCREEN | RenderFlags.DEPTH_ONLY)
        self._pass = None  # a scene is held no longer than it is drawn
        GL.glDisable(GL.GL_SCISSOR_TEST)
        check("drawing shadow maps")

    def bind(self) -> None:
        """Put the array where programs with shadows look for it."""
        GL.glActiveTexture(GL.GL_TEXTURE0 + SHADOW_UNIT)
        GL.glBindTexture(GL.GL_TEXTURE_2D_ARRAY, self._texture)
        GL.glBindSampler(SHADOW_UNIT, 0)

    # Hooks of pyrender.Renderer, in the order in which its traversal calls them.

    def _update_context(self, scene: Any, flags: int) -> None:
        """Leave meshes and textures alone: caches that outlive the scene own them."""

    def _configure_forward_pass_viewport(self, flags: int) -> None:
        GL.glViewport(0, 0, self.viewport_width, self.viewport_height)
        GL.glScissor(0, 0, self.viewport_width, self.viewport_height)
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(True)
        GL.glDepthFunc(GL.GL_GREATER)
        GL.glClearDepth(0.0)
        GL.glDisable(GL.GL_BLEND)
        GL.glDisable(GL.GL_CULL_FACE)  # both sides keep light away
        GL.glLineWidth(1)
        GL.glPointSize(1)

    def _get_camera_matrices(self, scene: FlatScene) -> tuple[None, None]:
        """Give nothing: our programs have matrices of their own."""
        return None, None

    def _sorted_mesh_nodes(self, scene: FlatScene) -> list[PlacedNode]:
        return scene.casters

    def _get_primitive_program(
        self, primitive: SurfacePrimitive, flags: int, program_flags: int
    ) -> Program:
        layout = primitive.material.shading.layout
        if layout.has_holes:
            return self._programs.get(layout, lambda: hole_sources(layout))
        return self._programs.get("solid", _solid_sources)

    def _bind_and_draw_primitive(
        self, primitive: SurfacePrimitive, pose: Matrix, program: Program, flags: int
    ) -> None:
        assert self._pass is not None
        if primitive.mesh.tile is not None:
            return  # what has no end would keep all light away
        program.set("clip_from_object", self._pass.clip_from_object[primitive.number])
        if primitive.material.shading.layout.has_holes:
            self._pass.scene.place(program, primitive)
            self._units.bind(program, primitive.material.shading, partly=True)
        primitive.mesh.bind()
        primitive.mesh.draw()
        GL.glBindVertexArray(0)

    def _read_main_framebuffer(self, scene: Any, flags: int) -> None:
        """Read nothing: the maps are textures."""

    def _fit(self, resolution: int, layers: int) -> None:
        """Have a texture of this size, and keep it until another one is needed."""
        if self._size == (resolution, layers):
            return
        self.free()
        self._size = (resolution, layers)
        self._texture = int(GL.glGenTextures(1))
        GL.glBindTexture(GL.GL_TEXTURE_2D_ARRAY, self._texture)
        GL.glTexImage3D(
            GL.GL_TEXTURE_2D_ARRAY,
            0,
            GL.GL_DEPTH_COMPONENT32F,
            resolution,
            resolution,
            layers,
            0,
            GL.GL_DEPTH_COMPONENT,
            GL.GL_FLOAT,
            None,
        )
        for name in (GL.GL_TEXTURE_MIN_FILTER, GL.GL_TEXTURE_MAG_FILTER):
            GL.glTexParameteri(GL.GL_TEXTURE_2D_ARRAY, name, GL.GL_NEAREST)
        GL.glBindTexture(GL.GL_TEXTURE_2D_ARRAY, 0)
        self._framebuffer = int(GL.glGenFramebuffers(1))
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._framebuffer)
        GL.glFramebufferTextureLayer(GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, self._texture, 0, 0)
        GL.glDrawBuffer(GL.GL_NONE)
        GL.glReadBuffer(GL.GL_NONE)
        status = int(GL.glCheckFramebufferStatus(GL.GL_FRAMEBUFFER))
        if status != int(GL.GL_FRAMEBUFFER_COMPLETE):
            raise RenderError(f"{layers} shadow maps of {resolution} texels: {status:#x}")

    def trim(self) -> None:
        """Free the maps, which are large, and programs beyond the bound."""
        self.free()
        self._programs.trim()

    def free(self) -> None:
        """Free the maps."""
        if self._texture:
            GL.glDeleteFramebuffers(1, [self._framebuffer])
            GL.glDeleteTextures([self._texture])
        self._framebuffer = self._texture = 0
        self._size = (0, 0)

    def delete(self) -> None:
        """Free everything."""
        self.free()
        self._programs.delete()


def _solid_sources() -> tuple[Source, Source]:
    return join(chunk("mesh.vert"), "mesh.vert"), join(_NOTHING, "solid")
