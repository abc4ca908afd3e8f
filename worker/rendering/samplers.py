"""How textures are read: wrap, border and filter as OpenGL sampler objects."""

from dataclasses import dataclass

import numpy as np

from api_schemas.families import Wrap
from api_schemas.maps import Filter
from worker.rendering.gl_context import GL, floats

_MODE = {
    "repeat": GL.GL_REPEAT,
    "mirror": GL.GL_MIRRORED_REPEAT,
    "clamp": GL.GL_CLAMP_TO_EDGE,
    "border": GL.GL_CLAMP_TO_BORDER,
}
_PERIOD: dict[Wrap, float] = {"repeat": 1.0, "mirror": 2.0, "clamp": 0.0, "border": 0.0}
_MOST_SAMPLERS = 256


@dataclass(frozen=True, slots=True)
class Sampling:
    """What the JIT compiles into the code that reads a texture.

    Attributes:
        wrap: Along u and v.
        smooth: Blend neighbouring texels.
        levels: Blend neighbouring mip levels.
    """

    wrap: tuple[Wrap, Wrap]
    smooth: bool
    levels: bool

    @classmethod
    def of(cls, wrap: tuple[Wrap, Wrap], filter_name: Filter) -> "Sampling":
        """Give the state that a filter of the language needs."""
        return cls(
            wrap=wrap,
            smooth=filter_name not in ("nearest", "summed_area"),
            levels=filter_name in ("trilinear", "anisotropic", "ewa"),
        )

    @property
    def period(self) -> tuple[float, float, float, float]:
        """Periods of the wrap along u and v and their inverses, 0 where it does not repeat."""
        u, v = (_PERIOD[wrap] for wrap in self.wrap)
        return (u, v, 1 / u if u else 0.0, 1 / v if v else 0.0)


class SamplerCache:
    """Sampler objects by state and border; few states exist, borders may be anything."""

    def __init__(self) -> None:
        """Begin with no samplers."""
        self._samplers: dict[tuple[Sampling, tuple[float, ...]], int] = {}

    def get(self, sampling: Sampling, border: tuple[float, ...]) -> int:
        """Return the sampler object of a state and a border value (four numbers, linear)."""
        key = (sampling, border)
        if key not in self._samplers:
            self._samplers[key] = _new_sampler(sampling, border)
        return self._samplers[key]

    def trim(self) -> None:
        """Free all samplers if there are many; call it between scenes."""
        if len(self._samplers) > _MOST_SAMPLERS:
            self.delete()

    def delete(self) -> None:
        """Free all samplers."""
        if self._samplers:
            samplers = np.array(list(self._samplers.values()), dtype=np.uint32)
            GL.glDeleteSamplers(len(samplers), samplers)
        self._samplers.clear()


def _new_sampler(sampling: Sampling, border: tuple[float, ...]) -> int:
    sampler = int(GL.glGenSamplers(1))
    magnify = GL.GL_LINEAR if sampling.smooth else GL.GL_NEAREST
    minify = GL.GL_LINEAR_MIPMAP_LINEAR if sampling.levels else magnify
    GL.glSamplerParameteri(sampler, GL.GL_TEXTURE_MAG_FILTER, magnify)
    GL.glSamplerParameteri(sampler, GL.GL_TEXTURE_MIN_FILTER, minify)
    GL.glSamplerParameteri(sampler, GL.GL_TEXTURE_WRAP_S, _MODE[sampling.wrap[0]])
    GL.glSamplerParameteri(sampler, GL.GL_TEXTURE_WRAP_T, _MODE[sampling.wrap[1]])
    GL.glSamplerParameteri(sampler, GL.GL_TEXTURE_WRAP_R, _MODE[sampling.wrap[1]])
    GL.glSamplerParameterfv(sampler, GL.GL_TEXTURE_BORDER_COLOR, floats(border))
    return sampler
