"""The part of a fragment shader that reads pictures, volumes, cube maps and formulas."""

from collections.abc import Callable, Iterable

from worker.rendering.shading_layout import SPACE_FILTERS, LookupLayout, ShadingLayout

SAMPLERS = {"picture": "sampler2D", "volume": "sampler3D", "cube": "samplerCube"}
"""GLSL types by kinds of textures."""


def lookup_chunks(layout: ShadingLayout) -> list[str]:
    """Return the chunks that readings need."""
    chunks = [call.chunk for lookup in layout.lookups for call in lookup.calls]
    for lookup in layout.lookups:
        if lookup.formula is not None:
            chunks += ["lib/lookup.glsl", "lib/reach.glsl", *lookup.formula.chunks]
        elif _kind(layout, lookup) == "picture":
            chunks.append(f"lib/sample_{lookup.filter}.glsl")
        else:
            chunks.append("lib/sample_space.glsl")
    return chunks


def lookup_declarations(layout: ShadingLayout, *, calls: bool = True) -> list[str]:
    """Declare what readings need, their formulas included; `calls`: of coordinates and layouts."""
    count = len(layout.lookups)
    if not count:
        return []
    lines = [
        f"uniform {SAMPLERS[picture.format.kind]} {name};"
        for name, picture in zip(layout.samplers, layout.pictures, strict=True)
        if name not in layout.tables
    ]
    lines += [
        f"uniform mat3 lookup_transform[{count}];",
        f"uniform vec4 lookup_period[{count}];",
        f"uniform vec2 lookup_size[{count}];",
    ]
    for number, lookup in enumerate(layout.lookups):
        for call in lookup.calls if calls else ():
            lines += call.declarations(number)
        if lookup.formula is not None:
            lines += lookup.formula.declarations
            lines += [
                f"vec4 evaluated_{number}(Reach at) {{",
                "    vec3 place = at.place, across_x = at.across_x, across_y = at.across_y;",
                f"    return {lookup.formula.call};",
                "}",
            ]
    return lines


def texels(
    layout: ShadingLayout, numbers: Iterable[int], place: Callable[[LookupLayout, int], str]
) -> list[str]:
    """Write the readings with these numbers; `place` gives what says where."""
    lines = []
    for number in numbers:
        lookup = layout.lookups[number]
        where = place(lookup, number)
        if lookup.returns == "Triplanar":
            lines += _three_texels(layout, lookup, number, where)
        else:
            lines.append(f"    vec4 texel_{number} = {_reading(layout, lookup, number, where)};")
    return lines


def place_of(layout: ShadingLayout, lookup: LookupLayout, number: int) -> str:
    """Write where to look: coordinates are of the point, a layout is of coordinates."""
    text = "point"
    for call in lookup.calls:
        text = call.text(text, number)
    flat = lookup.returns == "Reach" and not in_space(layout, lookup)
    return f"flat_reach({text})" if flat else text


def in_space(layout: ShadingLayout, lookup: LookupLayout) -> bool:
    """Whether it is read at three coordinates."""
    if lookup.formula is not None:
        return lookup.formula.solid
    return _kind(layout, lookup) != "picture"


def _three_texels(
    layout: ShadingLayout, lookup: LookupLayout, number: int, where: str
) -> list[str]:
    """Write three readings, blended so that a constant picture is constant to the last bit."""
    sides, texel = f"sides_{number}", f"texel_{number}"
    x, y, z = (_reading(layout, lookup, number, f"{sides}.along_{axis}") for axis in "xyz")
    weights = f"{sides}.weights"
    return [
        f"    Triplanar {sides} = {where};",
        f"    vec4 {texel} = {x};",
        f"    {texel} += {weights}.y * ({y} - {texel}) + {weights}.z * ({z} - {texel});",
    ]


def _reading(layout: ShadingLayout, lookup: LookupLayout, number: int, where: str) -> str:
    how = f"lookup_transform[{number}]"
    if lookup.formula is not None:
        return f"evaluated_{number}(transformed({where}, {how}))"
    name, kind = f"picture_{lookup.picture}", _kind(layout, lookup)
    how += f", lookup_period[{number}]"
    if kind == "picture":
        return f"sample_{lookup.filter}({name}, {looking(where, number)})"
    size = f"textureSize({name}, 0)"
    if kind == "cube":
        at = f"look_up_cube({where}, float({size}.x))"
    else:
        at = f"look_up_space({where}, {how}, vec3({size}))"
    chosen = lookup.filter if lookup.filter in SPACE_FILTERS else "anisotropic"
    return f"sample_{chosen}({name}, {at})"


def looking(where: str, number: int) -> str:
    """Write the Lookup of a picture at a place."""
    return (
        f"look_up({where}, lookup_transform[{number}], lookup_period[{number}], "
        f"lookup_size[{number}])"
    )


def _kind(layout: ShadingLayout, lookup: LookupLayout) -> str:
    return "picture" if lookup.picture is None else layout.pictures[lookup.picture].format.kind
