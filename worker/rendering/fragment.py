"""The fragment shader of a surface: its chunk, and generated code that fills its parameters."""

import re
from collections.abc import Sequence
from functools import partial

from worker.rendering.chunks import Source, chunk, join
from worker.rendering.light_code import light_chunks, light_lines
from worker.rendering.lookup_fragment import (
    in_space,
    looking,
    lookup_chunks,
    lookup_declarations,
    place_of,
    texels,
)
from worker.rendering.relief_fragment import aside, relief_chunks, tilts
from worker.rendering.shading import has_lobe, is_lit
from worker.rendering.shading_layout import (
    LightLayout,
    LookupLayout,
    Parameter,
    ShadingLayout,
    SkyKind,
)

VERSION = "#version 410 core"
_MAIN = ("base_color", "diffuse_color", "color")
"""Parameters whose map is the surface's picture, rather than any other one."""
_ASKED = re.compile(r"^\w+ (\w+)_at\(SurfacePoint point\);", re.MULTILINE)
_SELECTED = ["uniform int selected;", "uniform float selected_last;"]
_BY_OPACITY = {
    "mask": "    if (opacity < alpha_cutoff) discard;",
    "blend": "    color *= opacity;",
}


def surface_sources(
    layout: ShadingLayout, lights: LightLayout, *, layered: bool, plane: bool = False
) -> tuple[Source, Source]:
    """Return the vertex and the fragment source that draw a layout.

    Args:
        layout: The surface's.
        lights: What of the scene's lights the program is made for.
        layered: Whether all layers are drawn.
        plane: Whether the mesh is a plane without end.
    """
    fragment = _fragment(layout, lights, layered, plane)
    return join(chunk("mesh.vert"), "mesh.vert"), join(fragment, layout.technique)


def hole_sources(layout: ShadingLayout) -> tuple[Source, Source]:
    """Return the sources that draw the depth alone, with holes where little or nothing is."""
    read = [p for p in (layout.opacity, layout.selection) if p is not None]
    numbers = list(dict.fromkeys(p.lookup for p in read if p.lookup is not None))
    lines = _head(layout, ["lib/fragment.glsl", "lib/opacity.glsl"])
    for parameter in read:
        lines += _declarations(parameter)
    lines += [
        *(_SELECTED if layout.selection else []),
        "void main() {",
        "    SurfacePoint point = surface_point();",
        *texels(layout, numbers, partial(place_of, layout)),
    ]
    lines += _selection(layout)
    if layout.opacity:
        cutoff = "alpha_cutoff" if layout.alpha_mode == "mask" else "0.5"
        opacity = f"bounded({_value(layout.opacity)}, point.color.a)"
        lines.append(f"    if ({opacity} < {cutoff}) discard;")
    return join(chunk("mesh.vert"), "mesh.vert"), join("\n".join([*lines, "}"]), "hole")


def background_sources(layout: ShadingLayout) -> tuple[Source, Source]:
    """Return the sources that draw a mapped colour over the whole target, alpha included."""
    (color,) = layout.parameters
    texel = f"texel_{color.lookup}"
    lines = [
        *_head(layout, ["lib/background.glsl"], calls=False),
        *_declarations(color),
        "void main() {",
        *texels(layout, range(len(layout.lookups)), lambda lookup, number: "coordinates_picture()"),
        f"    vec3 light = color_scale * {texel}.rgb + color_bias * {texel}.a;",
        f"    color = holdable(vec4(light, clamp({texel}.a, 0.0, 1.0)));",
        "}",
    ]
    vertex = join(chunk("whole_target.vert"), "whole_target.vert")
    return vertex, join("\n".join(lines), "background")


def sky_sources(kind: SkyKind) -> tuple[Source, Source]:
    """Return the sources that draw what is behind everything as the eye looks through it."""
    lines = [
        VERSION,
        '#include "lib/sky_background.glsl"',
        f'#include "skies/{kind}.glsl"',
        "void main() {",
        "    vec3 towards = ray();",
        "    float reach = max(length(dFdx(towards)), length(dFdy(towards)));",
        "    color = holdable(vec4(sky_in_mirror(towards, reach, 0.0), 1.0));",
        "}",
    ]
    vertex = join(chunk("whole_target.vert"), "whole_target.vert")
    return vertex, join("\n".join(lines), "sky")


def _fragment(layout: ShadingLayout, lights: LightLayout, layered: bool, plane: bool) -> str:
    others = (layout.opacity, layout.light_map, layout.selection)
    parameters = [*layout.parameters, *(parameter for parameter in others if parameter)]
    chunks = [f"lib/{'infinite_plane' if plane else 'fragment'}.glsl"]
    chunks += [f"surfaces/{layout.technique}.glsl"]
    if has_lobe(layout.technique):
        chunks.append(f"lobes/{'streaked' if layout.streaked else 'round'}.glsl")
    chunks += relief_chunks(layout)
    chunks += ["lib/opacity.glsl"] if layout.opacity else []
    chunks += ["lib/layers.glsl"] if layered else []
    lit = is_lit(layout.technique) or lights.visibility
    if is_lit(layout.technique):
        chunks.append(f"skies/{lights.sky}.glsl")
    chunks += light_chunks(lights) if lit else []
    lines = _head(layout, chunks)
    lines += light_lines(lights) if lit else []
    for parameter in parameters:
        lines += _declarations(parameter)
    lines += _elsewhere(layout)
    lines += _SELECTED if layout.selection else []
    lines += ["void main() {", "    SurfacePoint point = surface_point();"]
    lines += _relief(layout)
    lines += _selection(layout)
    if layout.light_map:
        lines.append(f"    baked_radiance = {_value(layout.light_map)};")
    lines.append("    Surface surface;")
    lines += [f"    surface.{p.name} = {_value(p)};" for p in layout.parameters]
    lines.append("    color = holdable(shade(point, surface));")
    if layout.opacity:
        lines.append(f"    float opacity = bounded({_value(layout.opacity)}, point.color.a);")
        lines.append(_BY_OPACITY[layout.alpha_mode])
    if layered:
        lines.append(f"    write_layers(point, albedo(surface), color.a, {_density(layout)});")
    if lights.visibility:
        lines.append("    layer_tangent.a = light_visibility(point);")
    if plane:
        lines.append("    if (!on_plane()) discard;")
    return "\n".join([*lines, "}"])


def _elsewhere(layout: ShadingLayout) -> list[str]:
    """Write the functions of a chunk that ask what a parameter is at another point."""
    asked = set(_ASKED.findall(chunk(f"surfaces/{layout.technique}.glsl")))
    lines = []
    for parameter in layout.parameters:
        if parameter.name in asked:
            numbers = [] if parameter.lookup is None else [parameter.lookup]
            lines += [
                f"{parameter.type} {parameter.name}_at(SurfacePoint point) {{",
                *texels(layout, numbers, partial(place_of, layout)),
                f"    return {_value(parameter)};",
                "}",
            ]
    return lines


def _selection(layout: ShadingLayout) -> list[str]:
    """Write what leaves out the places of other surfaces; what is no number is the first one."""
    if layout.selection is None:
        return []
    return [
        f"    float chosen = {_value(layout.selection)};",
        "    chosen = isnan(chosen) ? 0.0 : clamp(floor(chosen + 0.5), 0.0, selected_last);",
        "    if (int(chosen) != selected) discard;",
    ]


def _head(layout: ShadingLayout, chunks: Sequence[str], *, calls: bool = True) -> list[str]:
    """Write the chunks and the uniforms of lookups."""
    chunks = [*chunks, *lookup_chunks(layout)]
    lines = [VERSION, *(f'#include "{name}"' for name in dict.fromkeys(chunks))]
    return lines + lookup_declarations(layout, calls=calls)


def _relief(layout: ShadingLayout) -> list[str]:
    """Write the readings of all pictures, and how some of them move and tilt the point.

    What tilts is read first, so that a bumped mirror reflects by its bumps.
    """
    plain = partial(place_of, layout)
    place = plain if layout.relief.parallax is None else partial(_moved_place, layout)

    def read(number: int) -> list[str]:
        return texels(layout, [number], place)

    early = layout.relief.tilting
    late = [number for number in range(len(layout.lookups)) if number not in early]
    return [
        *aside(layout, lambda number: plain(layout.lookups[number], number)),
        *tilts(layout.relief, read, lambda number: place(layout.lookups[number], number)),
        *texels(layout, late, place),
    ]


def _moved_place(layout: ShadingLayout, lookup: LookupLayout, number: int) -> str:
    text = place_of(layout, lookup, number)
    return text if in_space(layout, lookup) else f"moved({text}, aside)"


def _density(layout: ShadingLayout) -> str:
    """Write how many texels of the main picture fit along a pixel; without one it is 0."""
    mapped = {p.name: p.lookup for p in layout.parameters if p.lookup is not None}
    main = next((name for name in _MAIN if name in mapped), None)
    number = mapped[main] if main else next(iter(mapped.values()), None)
    if number is None:
        return "0.0"
    lookup = layout.lookups[number]
    if lookup.picture is None or lookup.returns == "Triplanar" or in_space(layout, lookup):
        return "0.0"
    place = place_of if layout.relief.parallax is None else _moved_place
    return f"texel_density({looking(place(layout, lookup, number), number)})"


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
