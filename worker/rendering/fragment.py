"""The fragment shader of a surface: its chunk, and generated code that fills its parameters."""

from worker.rendering.chunks import Source, chunk, join
from worker.rendering.shading import LookupLayout, Parameter, ShadingLayout

VERSION = "#version 410 core"


def surface_sources(layout: ShadingLayout) -> tuple[Source, Source]:
    """Return the vertex and the fragment source that draw a layout."""
    return join(chunk("mesh.vert"), "mesh.vert"), join(_fragment(layout), layout.technique)


def _fragment(layout: ShadingLayout) -> str:
    lookups = layout.lookups
    chunks = [
        "lib/fragment.glsl",
        f"surfaces/{layout.technique}.glsl",
        *(f"coordinates/{lookup.coordinates}.glsl" for lookup in lookups),
        *(f"lib/sample_{lookup.filter}.glsl" for lookup in lookups),
    ]
    lines = [VERSION, *(f'#include "{name}"' for name in dict.fromkeys(chunks))]
    if lookups:
        lines += [
            *(f"uniform sampler2D picture_{index};" for index in range(len(layout.pictures))),
            f"uniform mat3 lookup_transform[{len(lookups)}];",
            f"uniform vec4 lookup_period[{len(lookups)}];",
            f"uniform vec2 lookup_size[{len(lookups)}];",
        ]
    for parameter in layout.parameters:
        lines += _declarations(parameter)
    lines += ["void main() {", "    SurfacePoint point = surface_point();"]
    for index, lookup in enumerate(lookups):
        lines.append(
            f"    vec4 texel_{index} = sample_{lookup.filter}(picture_{lookup.picture}, "
            f"look_up({_coordinates(lookup)}, lookup_transform[{index}], "
            f"lookup_period[{index}], lookup_size[{index}]));"
        )
    lines.append("    Surface surface;")
    lines += [f"    surface.{p.name} = {_value(p)};" for p in layout.parameters]
    lines += ["    color = holdable(shade(point, surface));", "}"]
    return "\n".join(lines)


def _coordinates(lookup: LookupLayout) -> str:
    return f"coordinates_{lookup.coordinates}({', '.join(['point', *map(str, lookup.choices)])})"


def _declarations(parameter: Parameter) -> list[str]:
    if parameter.lookup is None:
        return [f"uniform {parameter.type} {parameter.name}_value;"]
    declared = [
        f"uniform {parameter.type} {parameter.name}_scale;",
        f"uniform float {parameter.name}_bias;",
    ]
    if parameter.type == "float":
        declared.append(f"uniform int {parameter.name}_channel;")
    return declared


def _value(parameter: Parameter) -> str:
    name = parameter.name
    if parameter.lookup is None:
        return f"{name}_value"
    # Indexing the texel keeps an infinity in another channel out; a dot product would not.
    channel = ".rgb" if parameter.type == "vec3" else f"[{name}_channel]"
    return f"{name}_scale * texel_{parameter.lookup}{channel} + {name}_bias"
