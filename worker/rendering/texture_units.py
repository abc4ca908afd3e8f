"""The texture units of OpenGL: which picture each one holds, and how it is read."""

from worker.rendering.gl_context import GL
from worker.rendering.lookups import Picture
from worker.rendering.programs import Program
from worker.rendering.samplers import SamplerCache
from worker.rendering.shading import Shading
from worker.rendering.sky import Sky

COOKIE_UNIT = 26
"""The first of four. Maps take the first 24 units, a surface's tables the next ones, the faces of
layers the last."""
SHADOW_UNIT = 30


class TextureUnits:
    """Binds pictures, each only where another one was before."""

    def __init__(self) -> None:
        """Begin with nothing bound."""
        self._samplers = SamplerCache()
        self._bound: dict[int, Picture] = {}

    def forget(self) -> None:
        """Count on nothing that is bound; call it when others may have used the units."""
        self._bound.clear()

    def bind(self, program: Program, shading: Shading, *, partly: bool = False) -> None:
        """Give the bound program a surface's parameters and pictures; `partly`: what it declares.

        Raises:
            KeyError: It does not declare one of them.
        """
        for name, value in shading.uniforms.items():
            if not partly or name in program.uniforms:
                program.set(name, value)
        named = zip(shading.layout.samplers, shading.pictures, strict=True)
        for unit, (name, picture) in enumerate(named):
            if not partly or name in program.uniforms:
                program.set(name, unit)
                self.put(unit, picture)

    def bind_sky(self, program: Program, sky: Sky) -> None:
        """Give the bound program an environment, in units that no picture takes."""
        sky.bind(program, self._samplers)

    def put(self, unit: int, picture: Picture) -> None:
        """Let a unit hold a picture."""
        if self._bound.get(unit) != picture:
            self._bound[unit] = picture
            GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
            GL.glBindTexture(picture.texture.target, picture.texture.number)
            GL.glBindSampler(unit, self._samplers.get(picture.sampling, picture.border))

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._samplers.trim()

    def delete(self) -> None:
        """Free all samplers."""
        self._samplers.delete()
