"""What lib/layers.glsl asks for beside the things every program is given."""

from worker.rendering.frame import Frame
from worker.rendering.gl_context import GL
from worker.rendering.programs import Program
from worker.rendering.vertex_arrays import VertexArray

_UNIT = 31  # maps take the first 24


class LayerUniforms:
    """Sets the uniforms of programs with layers, and keeps the faces of what is being drawn."""

    def __init__(self) -> None:
        """Begin with nothing in OpenGL."""
        self._faces: dict[int, tuple[int, int]] = {}

    def set(self, program: Program, frame: Frame, mesh: VertexArray) -> None:
        """Tell the bound program where the eye is and how the mesh's triangles lie."""
        world_from_camera = frame.scene.view.world_from_camera
        program.set("samples_per_side", frame.supersampling)
        program.set("view_axis", -world_from_camera[:3, 2])
        program.set("has_faces", mesh.has_sides)
        program.set("face_normals", _UNIT)
        if mesh.has_sides:
            GL.glActiveTexture(GL.GL_TEXTURE0 + _UNIT)
            GL.glBindTexture(GL.GL_TEXTURE_BUFFER, self._texture(mesh))

    def trim(self) -> None:
        """Free the faces of what was drawn."""
        for buffer, texture in self._faces.values():
            GL.glDeleteTextures([texture])
            GL.glDeleteBuffers(1, [buffer])
        self._faces.clear()

    def _texture(self, mesh: VertexArray) -> int:
        if mesh.number not in self._faces:
            normals = mesh.face_normals()
            buffer, texture = int(GL.glGenBuffers(1)), int(GL.glGenTextures(1))
            GL.glBindBuffer(GL.GL_TEXTURE_BUFFER, buffer)
            GL.glBufferData(GL.GL_TEXTURE_BUFFER, normals.nbytes, normals, GL.GL_STATIC_DRAW)
            GL.glBindTexture(GL.GL_TEXTURE_BUFFER, texture)
            GL.glTexBuffer(GL.GL_TEXTURE_BUFFER, GL.GL_RGB32F, buffer)
            self._faces[mesh.number] = (buffer, texture)
        return self._faces[mesh.number][1]
