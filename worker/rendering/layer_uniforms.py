"""What lib/layers.glsl asks for beside the things every program is given."""

from worker.geometry.transforms import Matrix
from worker.rendering.gl_context import GL
from worker.rendering.programs import Program

_UNITS = {"mesh_vertices": 30, "mesh_indices": 31}  # maps take the first 24
_FORMATS = {"mesh_vertices": GL.GL_R32F, "mesh_indices": GL.GL_R32UI}


class LayerUniforms:
    """Sets the uniforms of programs with layers; it owns two views of the mesh that is drawn."""

    def __init__(self) -> None:
        """Begin with nothing in OpenGL."""
        self._views: dict[str, int] = {}

    def set(
        self,
        program: Program,
        world_from_camera: Matrix,
        buffers: tuple[int, int],
        stride: int,
    ) -> None:
        """Tell the bound program where the eye is and what the mesh is made of.

        Args:
            program: It includes lib/layers.glsl.
            world_from_camera: The eye.
            buffers: The mesh's vertices, positions first, and its indices.
            stride: Floats from one vertex to the next; 0 for what has no triangles.
        """
        program.set("eye_position", world_from_camera[:3, 3])
        program.set("view_axis", -world_from_camera[:3, 2])
        program.set("mesh_stride", stride)
        if not self._views:
            self._views = {name: int(GL.glGenTextures(1)) for name in _UNITS}
        for (name, unit), buffer in zip(_UNITS.items(), buffers, strict=True):
            GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
            GL.glBindTexture(GL.GL_TEXTURE_BUFFER, self._views[name])
            GL.glTexBuffer(GL.GL_TEXTURE_BUFFER, _FORMATS[name], buffer)
            program.set(name, unit)

    def delete(self) -> None:
        """Free the views."""
        if self._views:
            GL.glDeleteTextures(list(self._views.values()))
            self._views = {}
