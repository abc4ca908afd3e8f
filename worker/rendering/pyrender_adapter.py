"""pyrender's Renderer with our programs, our float targets and our uniforms.

Of pyrender remain the scene, the traversal and the contexts. Overridden are its private hooks,
which a pinned version and a test keep where they are. Not used are its shaders, which clamp and
encode, its textures, which truncate floats, its vertex buffers, whose attributes move, and its
lights.
"""

import time
from collections.abc import Callable, Hashable
from dataclasses import replace
from typing import Any

import numpy as np
import pyrender
from pyrender.constants import RenderFlags

from worker.geometry.transforms import Matrix, rigid_inverse
from worker.rendering.chunks import Source
from worker.rendering.fragment import background_sources, sky_sources, surface_sources
from worker.rendering.frame import Frame, TraversedProgram
from worker.rendering.gl_context import GL, GLContext, check, floats
from worker.rendering.layer_uniforms import LayerUniforms
from worker.rendering.lighting import Lighting
from worker.rendering.programs import Program, ProgramCache
from worker.rendering.pyrender_scene import FlatScene, PlacedNode, SurfacePrimitive
from worker.rendering.shading import Shading, is_lit
from worker.rendering.shading_layout import LightLayout
from worker.rendering.shadow_maps import ShadowMaps
from worker.rendering.sky import Sky
from worker.rendering.targets import Target
from worker.rendering.texture_units import COOKIE_UNIT, SHADOW_UNIT, TextureUnits


class FloatRenderer(pyrender.Renderer):  # type: ignore[misc]
    """Draws scenes into float32 targets.

    Attributes:
        jit_seconds: Time spent so far in linking programs and in their first draws.
    """

    def __init__(self, context: GLContext) -> None:
        """Prepare to draw in an open context."""
        super().__init__(1, 1)
        self._context = context
        self._programs = ProgramCache(TraversedProgram)
        self._units = TextureUnits()
        self._shadows = ShadowMaps(self._units)
        self._layers = LayerUniforms()
        self._frame: Frame | None = None
        self._frames = 0
        self._stream = 0  # a buffer of elements in another order
        self._no_vertices = 0
        self.jit_seconds = 0.0

    def draw(
        self,
        scene: FlatScene,
        lights: Lighting,
        target: Target,
        tile_from_picture: Matrix,
        size: tuple[int, int],
        supersampling: int,
    ) -> None:
        """Draw one tile into the lower left part of a target; where nothing is, all four are 0.

        Args:
            scene: What to draw.
            lights: What shines on it; draw_shadows must have seen it if any casts shadows.
            target: Where the samples go.
            tile_from_picture: Stretches the tile's part of clip space over all of it.
            size: The tile's width and height in samples.
            supersampling: Samples along each side of a pixel, as wide as lines and points are.

        Raises:
            RenderError: OpenGL complains, or this is not the context's thread.
        """
        self._context.check_thread()
        view = scene.view
        camera_from_world = rigid_inverse(view.world_from_camera)
        clip_from_world = tile_from_picture @ view.clip_from_camera @ camera_from_world
        picture = np.diag(tile_from_picture)[:2] * size
        self._frames += 1
        self._frame = Frame(
            number=self._frames,
            scene=scene,
            lights=lights,
            target=target,
            clip_from_object=clip_from_world @ scene.world_from_object,
            size=np.array(size),
            corner=np.rint((picture - (1 + tile_from_picture[:2, 3]) * size) / 2),
            picture=np.rint(picture / supersampling),
            supersampling=supersampling,
            tile_from_picture=tile_from_picture,
            blending=False,
        )
        self._units.forget()
        if lights.views:
            self._shadows.bind()
        for unit, cookie in enumerate(lights.cookies.pictures, COOKIE_UNIT):
            self._units.put(unit, cookie)
        self.viewport_width, self.viewport_height = size
        GL.glLineWidth(supersampling)
        GL.glPointSize(supersampling)
        self.render(scene, RenderFlags.OFFSCREEN)
        self._frame = None  # a scene is held no longer than it is drawn
        check("drawing a tile")

    def draw_shadows(self, scene: FlatScene, lights: Lighting) -> None:
        """Draw what the lights of a scene see, if any casts shadows; its tiles come after.

        Raises:
            RenderError: OpenGL complains, or this is not the context's thread.
        """
        self._context.check_thread()
        if lights.views:
            self._shadows.draw_views(scene, lights.views)

    # Hooks of pyrender.Renderer, in the order in which its traversal calls them.

    def _update_context(self, scene: Any, flags: int) -> None:
        """Leave meshes and textures alone: caches that outlive the scene own them."""

    def _configure_forward_pass_viewport(self, flags: int) -> None:
        assert self._frame is not None
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, self._frame.target.framebuffer)
        self._frame.target.write(averaged=True, nearest=True)
        GL.glViewport(0, 0, self.viewport_width, self.viewport_height)
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(True)
        GL.glDepthFunc(GL.GL_GREATER)
        GL.glClearDepth(0.0)
        GL.glDisable(GL.GL_BLEND)
        GL.glEnable(GL.GL_CULL_FACE)

    def _get_camera_matrices(self, scene: FlatScene) -> tuple[None, None]:
        """Draw the background: this is called when the target has been cleared.

        Our programs have matrices of their own.
        """
        assert self._frame is not None
        if isinstance(scene.background, Shading):
            self._draw_background(scene.background)
        elif isinstance(scene.background, Sky):
            self._draw_sky(scene, scene.background)
        elif scene.background is not None:
            GL.glClearBufferfv(GL.GL_COLOR, 0, floats([*scene.background, 1.0]))
        return None, None

    def _sorted_mesh_nodes(self, scene: FlatScene) -> list[PlacedNode]:
        return scene.in_order

    def _get_primitive_program(
        self, primitive: SurfacePrimitive, flags: int, program_flags: int
    ) -> Program:
        assert self._frame is not None
        layout, layered = primitive.material.shading.layout, self._frame.target.layered
        lights = LightLayout()
        if is_lit(layout.technique):
            sky = self._frame.scene.sky_of(primitive)
            lights = replace(
                self._frame.lights.layout, sky=sky.kind_for(layout.technique) if sky else "none"
            )
        elif self._frame.lights.layout.visibility:
            lights = self._frame.lights.layout
        plane = primitive.mesh.tile is not None
        return self._linked(
            (layout, lights, layered, plane),
            lambda: surface_sources(layout, lights, layered=layered, plane=plane),
        )

    def _bind_lighting(
        self, scene: FlatScene, program: TraversedProgram, node: PlacedNode, flags: int
    ) -> None:
        assert self._frame is not None
        if program.frame == self._frame.number:
            return
        program.frame = self._frame.number
        # Coordinates may ask where the lamps are, and not for their shadows.
        cookies = self._frame.lights.layout.samplers
        units = {"shadow_maps": SHADOW_UNIT} | {
            name: unit for unit, name in enumerate(cookies, COOKIE_UNIT)
        }
        for name, value in {**self._frame.lights.uniforms, **units}.items():
            if name in program.uniforms:
                program.set(name, value)

    def _bind_and_draw_primitive(
        self, primitive: SurfacePrimitive, pose: Matrix, program: Program, flags: int
    ) -> None:
        assert self._frame is not None
        self._frame.place(program, primitive)
        self._units.bind(program, primitive.material.shading)
        sky = self._frame.scene.sky_of(primitive)
        if sky is not None and "sky_from_world" in program.uniforms:
            self._units.bind_sky(program, sky)
        if self._frame.target.layered:
            program.set("object_id", primitive.thing)
            program.set("material_id", primitive.material.number)
            self._layers.set(program, self._frame, primitive.mesh)
        if primitive.material.shading.layout.alpha_mode == "blend" and not self._frame.blending:
            self._begin_blending()
        start = time.perf_counter()
        primitive.mesh.bind()
        # A mirrored transform turns the winding, but not which side is the outer one.
        GL.glFrontFace(GL.GL_CW if primitive.clockwise else GL.GL_CCW)
        for hidden in primitive.hidden:
            if hidden is None:
                GL.glDisable(GL.GL_CULL_FACE)
            else:
                GL.glEnable(GL.GL_CULL_FACE)
                GL.glCullFace(hidden)
            if primitive.elements is None:
                primitive.mesh.draw()
            else:
                self._stream = self._stream or int(GL.glGenBuffers(1))
                primitive.mesh.draw_in_order(primitive.elements, self._stream)
        GL.glBindVertexArray(0)
        self._drawn(program, start)

    def _read_main_framebuffer(self, scene: Any, flags: int) -> None:
        """Read nothing: the tile is resolved first."""

    def _begin_blending(self) -> None:
        """Let colours, premultiplied, lie over what is there; depth is asked but not changed."""
        assert self._frame is not None
        self._frame.blending = True
        self._frame.target.write(averaged=True, nearest=False)
        GL.glDepthMask(False)
        GL.glEnable(GL.GL_BLEND)
        GL.glBlendFunc(GL.GL_ONE, GL.GL_ONE_MINUS_SRC_ALPHA)

    def _draw_background(self, shading: Shading) -> None:
        assert self._frame is not None
        program = self._linked(
            ("background", shading.layout), lambda: background_sources(shading.layout)
        )
        program.bind()
        program.set("corner", self._frame.corner)
        program.set("picture_size", self._frame.picture)
        program.set("samples_per_side", self._frame.supersampling)
        self._units.bind(program, shading)
        self._cover(program)

    def _draw_sky(self, scene: FlatScene, sky: Sky) -> None:
        assert self._frame is not None
        program = self._linked(("sky", sky.kind), lambda: sky_sources(sky.kind))
        program.bind()
        self._units.bind_sky(program, sky)
        for name, ray in scene.view.rays(self._frame.tile_from_picture).items():
            program.set(name, ray)
        program.set("tile_size", (self.viewport_width, self.viewport_height))
        self._cover(program)

    def _cover(self, program: Program) -> None:
        """Draw over the whole tile, behind everything."""
        assert self._frame is not None
        start = time.perf_counter()
        self._no_vertices = self._no_vertices or int(GL.glGenVertexArrays(1))
        self._frame.target.write(averaged=False, nearest=False)
        GL.glDisable(GL.GL_DEPTH_TEST)  # nor is any depth written then
        GL.glDisable(GL.GL_CULL_FACE)
        GL.glBindVertexArray(self._no_vertices)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glBindVertexArray(0)
        GL.glEnable(GL.GL_DEPTH_TEST)
        self._frame.target.write(averaged=True, nearest=True)
        self._drawn(program, start)

    def _linked(
        self, key: Hashable, sources: Callable[[], tuple[Source, Source]]
    ) -> TraversedProgram:
        start = time.perf_counter()
        program = self._programs.get(key, sources)
        if not program.drawn:
            self.jit_seconds += time.perf_counter() - start
        return program

    def _drawn(self, program: Program, start: float) -> None:
        """Count the time of a program's first draw, which compiles it."""
        if not program.drawn:
            program.drawn = True
            self.jit_seconds += time.perf_counter() - start

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._programs.trim()
        self._units.trim()
        self._shadows.trim()
        self._layers.trim()

    def delete(self) -> None:
        """Free programs, samplers and buffers."""
        self._programs.delete()
        self._units.delete()
        self._shadows.delete()
        self._layers.trim()
        GL.glDeleteBuffers(1, [self._stream])
        GL.glDeleteVertexArrays(1, [self._no_vertices])
        self._stream = self._no_vertices = 0
