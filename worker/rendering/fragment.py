"""The fragment shader of a surface: its chunk, and generated code that fills its parameters."""

from collections.abc import Callable, Iterable, Sequence

from worker.rendering.chunks import Source, chunk, join
from worker.rendering.light_code import light_chunks, light_lines
from worker.rendering.relief_fragment import aside, relief_chunks, tilts
from worker.rendering.shading import is_lit
from worker.rendering.shading_layout import (
    LightLayout,
    LookupLayout,
    Parameter,
    ShadingLayout,
)

VERSION = "#version 410 core"
_MAIN = ("base_color", "diffuse_color", "color")
"""Parameters whose map is the surface's picture, rather than any other one."""
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
    calls = [(call, number) for number in numbers for call in layout.lookups[number].calls]
    chunks = ["lib/fragment.glsl", "lib/opacity.glsl", *(call.chunk for call, _ in calls)]
    lines = _head(layout, chunks)
    for call, number in calls:
        lines += call.declarations(number)
    for parameter in read:
        lines += _declarations(parameter)
    lines += [
        *(_SELECTED if layout.selection else []),
        "void main() {",
        "    SurfacePoint point = surface_point();",
        *_texels(layout, numbers, _place),
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
        *_head(layout, ["lib/background.glsl"]),
        *_declarations(color),
        "void main() {",
        *_texels(
            layout, range(len(layout.lookups)), lambda lookup, number: "coordinates_picture()"
        ),
        f"    vec3 light = color_scale * {texel}.rgb + color_bias * {texel}.a;",
        f"    color = holdable(vec4(light, clamp({texel}.a, 0.0, 1.0)));",
        "}",
    ]
    vertex = join(chunk("whole_target.vert"), "whole_target.vert")
    return vertex, join("\n".join(lines), "background")


def _fragment(layout: ShadingLayout, lights: LightLayout, layered: bool, plane: bool) -> str:
    others = (layout.opacity, layout.light_map, layout.selection)
    parameters = [*layout.parameters, *(parameter for parameter in others if parameter)]
    chunks = [f"lib/{'infinite_plane' if plane else 'fragment'}.glsl"]
    chunks += [f"surfaces/{layout.technique}.glsl"]
    calls = [(call, n) for n, lookup in enumerate(layout.lookups) for call in lookup.calls]
    chunks += [call.chunk for call, _ in calls]
    chunks += relief_chunks(layout.relief)
    chunks += ["lib/opacity.glsl"] if layout.opacity else []
    chunks += ["lib/layers.glsl"] if layered else []
    if is_lit(layout.technique):
        chunks += light_chunks(lights)
    lines = _head(layout, chunks)
    if is_lit(layout.technique):
        lines += light_lines(lights)
    for call, number in calls:
        lines += call.declarations(number)
    for parameter in parameters:
        lines += _declarations(parameter)
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
    if plane:
        lines.append("    if (!on_plane()) discard;")
    return "\n".join([*lines, "}"])


def _selection(layout: ShadingLayout) -> list[str]:
    """Write what leaves out the places of other surfaces; what is no number is the first one."""
    if layout.selection is None:
        return []
    return [
        f"    float chosen = {_value(layout.selection)};",
        "    chosen = isnan(chosen) ? 0.0 : clamp(floor(chosen + 0.5), 0.0, selected_last);",
        "    if (int(chosen) != selected) discard;",
    ]


def _head(layout: ShadingLayout, chunks: Sequence[str]) -> list[str]:
    """Write the chunks and the uniforms of lookups."""
    lookups = layout.lookups
    chunks = [*chunks, *(f"lib/sample_{lookup.filter}.glsl" for lookup in lookups)]
    lines = [VERSION, *(f'#include "{name}"' for name in dict.fromkeys(chunks))]
    if lookups:
        lines += [
            *(
                f"uniform sampler2D {name};"
                for name in layout.samplers
                if name not in layout.tables
            ),
            f"uniform mat3 lookup_transform[{len(lookups)}];",
            f"uniform vec4 lookup_period[{len(lookups)}];",
            f"uniform vec2 lookup_size[{len(lookups)}];",
        ]
    return lines


def _relief(layout: ShadingLayout) -> list[str]:
    """Write the readings of all pictures, and how some of them move and tilt the point.

    What tilts is read first, so that a bumped mirror reflects by its bumps.
    """
    place = _place if layout.relief.parallax is None else _moved_place

    def read(number: int) -> list[str]:
        return _texels(layout, [number], place)

    early = layout.relief.tilting
    late = [number for number in range(len(layout.lookups)) if number not in early]
    return [
        *aside(layout, lambda number: _place(layout.lookups[number], number)),
        *tilts(layout.relief, read, lambda number: place(layout.lookups[number], number)),
        *_texels(layout, late, place),
    ]


def _texels(
    layout: ShadingLayout, numbers: Iterable[int], place: Callable[[LookupLayout, int], str]
) -> list[str]:
    """Write the readings with these numbers; `place` gives what says where."""
    lines = []
    for number in numbers:
        where = place(layout.lookups[number], number)
        if layout.lookups[number].returns == "Triplanar":
            lines += _three_texels(layout.lookups[number], number, where)
        else:
            lines.append(
                f"    vec4 texel_{number} = {_reading(layout.lookups[number], number, where)};"
            )
    return lines


def _three_texels(lookup: LookupLayout, number: int, where: str) -> list[str]:
    """Write three readings, blended so that a constant picture is constant to the last bit."""
    sides, texel = f"sides_{number}", f"texel_{number}"
    x, y, z = (_reading(lookup, number, f"{sides}.along_{axis}") for axis in "xyz")
    weights = f"{sides}.weights"
    return [
        f"    Triplanar {sides} = {where};",
        f"    vec4 {texel} = {x};",
        f"    {texel} += {weights}.y * ({y} - {texel}) + {weights}.z * ({z} - {texel});",
    ]


def _reading(lookup: LookupLayout, number: int, where: str) -> str:
    return f"sample_{lookup.filter}(picture_{lookup.picture}, {_looking(where, number)})"


def _looking(where: str, number: int) -> str:
    return (
        f"look_up({where}, lookup_transform[{number}], lookup_period[{number}], "
        f"lookup_size[{number}])"
    )


def _place(lookup: LookupLayout, number: int) -> str:
    """Write where to look: coordinates are of the point, a layout is of coordinates."""
    text = "point"
    for call in lookup.calls:
        text = call.text(text, number)
    return f"flat_reach({text})" if lookup.returns == "Reach" else text


def _moved_place(lookup: LookupLayout, number: int) -> str:
    return f"moved({_place(lookup, number)}, aside)"


def _density(layout: ShadingLayout) -> str:
    """Write how many texels of the main picture fit along a pixel; without one it is 0."""
    mapped = {p.name: p.lookup for p in layout.parameters if p.lookup is not None}
    main = next((name for name in _MAIN if name in mapped), None)
    number = mapped[main] if main else next(iter(mapped.values()), None)
    if number is None or layout.lookups[number].returns == "Triplanar":
        return "0.0"
    place = _place if layout.relief.parallax is None else _moved_place
    return f"texel_density({_looking(place(layout.lookups[number], number), number)})"


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
