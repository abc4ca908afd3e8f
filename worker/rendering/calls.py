"""Calls of the shader chunks that bear a technique's name, with a spec's parameters as arguments.

A chunk's function is the signature of the call: those of its parameters that are named like a
field of the spec are filled from it, the others are the renderer's to give. What is declared
`const int` is a constant of the program, a word's place among the choices; all else is a uniform.
"""

import functools
import re
from dataclasses import dataclass
from typing import Any, get_args

from api_schemas.families import TechniqueSpec
from worker.errors import RenderError
from worker.rendering.chunks import chunk

_FUNCTION = r"^(?P<returns>\w+) {name}\((?P<parameters>[^)]*)\) \{{"
_PARAMETER = re.compile(r"(?P<const>const )?(?P<type>\w+) (?P<name>\w+)(?:\[(?P<count>\d+)\])?")


@dataclass(frozen=True, slots=True)
class Argument:
    """A parameter that is a uniform: its GLSL type, the field it is of, and how many there are."""

    type: str
    field: str
    count: int | None


@dataclass(frozen=True, slots=True)
class Call:
    """A function of a chunk and what it is called with besides what the renderer gives.

    Attributes:
        chunk: The file below the shader folder.
        role: coordinates or layout, the first part of the names of function and uniforms.
        technique: The second part of the function's name.
        returns: The GLSL type it returns.
        arguments: Constants and uniforms, in the order of the signature.
    """

    chunk: str
    role: str
    technique: str
    returns: str
    arguments: tuple[int | Argument, ...]

    def text(self, given: str, owner: int | str) -> str:
        """Write the call; `owner` tells its uniforms from those of other calls."""
        arguments = [
            str(argument) if isinstance(argument, int) else self.uniform(argument, owner)
            for argument in self.arguments
        ]
        return f"{self.role}_{self.technique}({', '.join([given, *arguments])})"

    def uniform(self, argument: Argument, owner: int | str) -> str:
        """Name a uniform."""
        return f"{self.role}_{owner}_{argument.field}"

    def declarations(self, owner: int | str) -> list[str]:
        """Declare the uniforms of the call of this owner."""
        return [
            f"uniform {argument.type} {self.uniform(argument, owner)}"
            + (f"[{argument.count}];" if argument.count else ";")
            for argument in self.arguments
            if isinstance(argument, Argument)
        ]

    def values(self, spec: TechniqueSpec, owner: int | str) -> dict[str, Any]:
        """Return the uniforms of the call of this owner, by name."""
        return {
            self.uniform(argument, owner): getattr(spec, argument.field)
            for argument in self.arguments
            if isinstance(argument, Argument)
        }


def call_of(role: str, folder: str, spec: TechniqueSpec) -> Call:
    """Return the call of `role_technique` in the technique's chunk of a folder.

    Raises:
        RenderError: The technique has no such chunk, or its chunk no such function.
    """
    path = f"{folder}/{spec.technique}.glsl"
    returns, parameters = _signature(path, f"{role}_{spec.technique}")
    arguments: list[int | Argument] = []
    for const, kind, name, count in parameters:
        if name not in type(spec).model_fields:
            continue
        if const:
            arguments.append(choice(spec, name))
        else:
            arguments.append(Argument(kind, name, int(count) if count else None))
    return Call(path, role, spec.technique, returns, tuple(arguments))


def choice(spec: TechniqueSpec, name: str) -> int:
    """Return a field as a whole number: a word is its place among the choices."""
    value = getattr(spec, name)
    if isinstance(value, int):
        return value
    return get_args(type(spec).model_fields[name].annotation).index(value)


@functools.cache
def _signature(path: str, name: str) -> tuple[str, list[tuple[str, str, str, str]]]:
    try:
        found = re.search(_FUNCTION.format(name=name), chunk(path), re.MULTILINE)
    except FileNotFoundError:
        found = None
    if found is None:
        raise RenderError(f"there is no chunk {path} with a function {name}")
    return found["returns"], _PARAMETER.findall(found["parameters"])
