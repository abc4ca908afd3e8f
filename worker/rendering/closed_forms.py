"""Textures evaluated at the fragment: GLSL that calls their chunks, each parameter a uniform.

A chunk shaders/textures/<technique>.glsl has a function

    vec4 texture_<technique>(vec3 place, vec3 across_x, vec3 across_y, <parameters>)

of a place in tiles, 0 deep in a picture, and the steps from there to the pixel's neighbours on the
right and above. It gives what a sampler would: a grey as three equal channels, a missing alpha
as 1. A parameter `vec4 <field>_value` is the value, at the same place, of the texture in a field,
or, where there is none, a uniform like the others.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from worker.closed_form import ClosedForm, Parameter
from worker.rendering.chunks import chunk

_FUNCTION = re.compile(r"^vec4 texture_\w+\((?P<arguments>[^)]*)\)", re.MULTILINE)
_ARGUMENT = re.compile(r"(?P<type>\w+) (?P<name>\w+)(?P<count>\[\d+\])?")
_PLACE = 3
"""Arguments that say where: they come first."""
_VALUE = "_value"


@dataclass(frozen=True, slots=True)
class Formula:
    """What a shader needs to evaluate one closed form.

    Attributes:
        chunks: To be included before.
        declarations: Of uniforms, a line each.
        call: An expression of type vec4, of the variables place, across_x and across_y.
        uniforms: The value of each uniform.
    """

    chunks: tuple[str, ...]
    declarations: tuple[str, ...]
    call: str
    uniforms: Mapping[str, Parameter]


def formula(form: ClosedForm, name: str) -> Formula:
    """Write the call of a closed form; the names of its uniforms begin with `name`."""
    chunks: dict[str, None] = {}
    declarations: list[str] = []
    uniforms: dict[str, Parameter] = {}

    def call(form: ClosedForm, name: str) -> str:
        path = f"textures/{form.technique}.glsl"
        values = ["place", "across_x", "across_y"]
        for kind, argument, count in _arguments(path):
            own = f"{name}_{argument}"
            nested = form.inputs.get(argument.removesuffix(_VALUE))
            if argument.endswith(_VALUE) and nested is not None:
                values.append(call(nested, own))
                continue
            declarations.append(f"uniform {kind} {own}{count};")
            uniforms[own] = form.parameters[argument]
            values.append(own)
        chunks[path] = None
        return f"texture_{form.technique}({', '.join(values)})"

    expression = call(form, name)
    return Formula(tuple(chunks), tuple(declarations), expression, uniforms)


def _arguments(path: str) -> Iterator[tuple[str, str, str]]:
    """Yield type, name and length in brackets of what a chunk's function takes besides the place.

    Raises:
        ValueError: The chunk has no such function.
    """
    function = _FUNCTION.search(chunk(path))
    if function is None:
        raise ValueError(f"{path} has no texture function")
    for argument in function["arguments"].split(",")[_PLACE:]:
        match = _ARGUMENT.fullmatch(argument.strip())
        if match is None:
            raise ValueError(f"cannot read the argument {argument.strip()} of {path}")
        yield match["type"], match["name"], match["count"] or ""
