"""GLSL programs with typed uniforms: a wrong name or a wrong shape is an error, never silence."""

import re
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Any, Generic, Self, TypeVar

import numpy as np

from worker.errors import RenderError
from worker.rendering.chunks import Source
from worker.rendering.gl_context import GL, floats

_DECLARATION = re.compile(r"^uniform (?P<type>\w+) (?P<names>[^;]+);", re.MULTILINE)
_NAME = re.compile(r"(?P<name>\w+)(?:\[(?P<count>\d+)\])?")
_FLOATS = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4, "mat3": 9, "mat4": 16}
_WHOLE = ("int", "bool", "sampler2D", "sampler3D", "samplerCube", "sampler2DArray", "samplerBuffer")
PROGRAMS_MAX = 64
"""With its compiled variants a program takes about 2 MB, and maps combine without end."""


@dataclass(frozen=True, slots=True)
class Uniform:
    """A declared uniform; location is None where the compiler found that nothing depends on it."""

    type: str
    count: int
    location: int | None


@dataclass(slots=True)
class Program:
    """A linked program.

    Attributes:
        number: Its OpenGL object.
        uniforms: What its sources declare, by name.
        drawn: Whether it has drawn yet: its first draw pays for the JIT.
        held: The bytes of each uniform, so that setting one to what it is costs nothing.
    """

    number: int
    uniforms: dict[str, Uniform]
    drawn: bool = False
    held: dict[str, bytes] = field(default_factory=dict)

    @classmethod
    def link(cls, vertex: Source, fragment: Source) -> Self:
        """Compile and link two sources, and learn the uniforms they declare.

        Raises:
            RenderError: The compiler's message, with the names of the chunks it speaks of.
        """
        number = int(GL.glCreateProgram())
        for kind, source in ((GL.GL_VERTEX_SHADER, vertex), (GL.GL_FRAGMENT_SHADER, fragment)):
            shader = _compile(kind, source)
            GL.glAttachShader(number, shader)
            GL.glDeleteShader(shader)
        GL.glLinkProgram(number)
        if not GL.glGetProgramiv(number, GL.GL_LINK_STATUS):
            raise RenderError(f"linking failed: {_text(GL.glGetProgramInfoLog(number))}")
        return cls(number, _uniforms(number, vertex.text + fragment.text))

    def bind(self) -> None:
        """Make it the current program."""
        GL.glUseProgram(self.number)

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteProgram(self.number)

    def set(self, name: str, value: Any) -> None:
        """Set a uniform of the bound program; matrices in row-major order, arrays may be shorter.

        Raises:
            KeyError: No source of this program declares the name.
            ValueError: The value does not have the declared shape.
        """
        uniform = self.uniforms[name]
        if uniform.type in _WHOLE:
            if np.ndim(value) != 0:
                raise ValueError(f"{name} is one {uniform.type}, not shape {np.shape(value)}")
            if uniform.location is not None and self._changes(name, b"%d" % value):
                GL.glUniform1i(uniform.location, int(value))
            return
        data = floats(value)
        count, rest = divmod(data.size, _FLOATS[uniform.type])
        if rest or not 1 <= count <= uniform.count:
            raise ValueError(f"{name} is {uniform.type}[{uniform.count}], not shape {data.shape}")
        if uniform.location is not None and self._changes(name, data.tobytes()):
            _SETTERS[uniform.type](uniform.location, count, data)

    def _changes(self, name: str, value: bytes) -> bool:
        if self.held.get(name) == value:
            return False
        self.held[name] = value
        return True


P = TypeVar("P", bound=Program)


class ProgramCache(Generic[P]):
    """Links each program once; the key decides what may share a program object."""

    def __init__(self, kind: type[P]) -> None:
        """Begin with no programs; `kind` is what they will be."""
        self._kind = kind
        self._programs: OrderedDict[Hashable, P] = OrderedDict()

    def get(self, key: Hashable, sources: Callable[[], tuple[Source, Source]]) -> P:
        """Return the program of this key, linking it from the sources the first time."""
        if key not in self._programs:
            self._programs[key] = self._kind.link(*sources())
        self._programs.move_to_end(key)
        return self._programs[key]

    def trim(self) -> None:
        """Free the least recently used beyond the bound; call it between scenes."""
        while len(self._programs) > PROGRAMS_MAX:
            self._programs.popitem(last=False)[1].delete()

    def __len__(self) -> int:
        """How many programs are kept."""
        return len(self._programs)

    def delete(self) -> None:
        """Free all programs."""
        for program in self._programs.values():
            program.delete()
        self._programs.clear()


def _compile(kind: int, source: Source) -> int:
    shader = int(GL.glCreateShader(kind))
    GL.glShaderSource(shader, source.text)
    GL.glCompileShader(shader)
    if not GL.glGetShaderiv(shader, GL.GL_COMPILE_STATUS):
        chunks = ", ".join(f"{index} = {name}" for index, name in enumerate(source.chunks))
        raise RenderError(f"{_text(GL.glGetShaderInfoLog(shader))} (chunks: {chunks})")
    return shader


def _uniforms(number: int, text: str) -> dict[str, Uniform]:
    found = {}
    for declaration in _DECLARATION.finditer(text):
        for name in declaration["names"].split(","):
            match = _NAME.fullmatch(name.strip())
            if match is None:
                raise RenderError(f"cannot read the declaration of {name.strip()}")
            location = int(GL.glGetUniformLocation(number, match["name"]))
            found[match["name"]] = Uniform(
                type=declaration["type"],
                count=int(match["count"] or 1),
                location=None if location < 0 else location,
            )
    return found


def _text(log: bytes | str) -> str:
    return (log.decode(errors="replace") if isinstance(log, bytes) else log).strip()


_SETTERS: dict[str, Callable[[int, int, Any], None]] = {
    "float": GL.glUniform1fv,
    "vec2": GL.glUniform2fv,
    "vec3": GL.glUniform3fv,
    "vec4": GL.glUniform4fv,
    "mat3": lambda location, count, data: GL.glUniformMatrix3fv(location, count, True, data),
    "mat4": lambda location, count, data: GL.glUniformMatrix4fv(location, count, True, data),
}
