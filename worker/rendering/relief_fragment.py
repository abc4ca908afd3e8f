"""The part of a fragment shader that moves and tilts a point before its surface is read."""

from collections.abc import Callable

from worker.rendering.shading_layout import ReliefLayout, ShadingLayout, Spread

_NORMALS = {
    "tangent": ("lib/normal_map.glsl", "tilted_normal"),
    "object": ("lib/object_normal_map.glsl", "own_normal"),
}


def relief_chunks(layout: ShadingLayout) -> list[str]:
    """Return the chunks that a surface's relief needs."""
    relief, chunks = layout.relief, []
    if relief.parallax is not None:
        chunks.append("lib/parallax.glsl")
        if any(lookup.returns == "Triplanar" for lookup in layout.lookups):
            chunks.append("lib/moved_sides.glsl")
    if relief.normal is not None:
        chunks.append(_NORMALS[relief.normal_space][0])
    if relief.bump is not None:
        chunks.append("lib/bump_map.glsl")
    chunks += ["lib/fine_normals.glsl"] if relief.roughened_by_normal else []
    chunks += ["lib/fine_bumps.glsl"] if relief.roughened_by_bump else []
    if relief.height is not None:
        chunks.append("lib/height_map.glsl")
    chunks += [f"lib/{spread.of}_ways.glsl" for spread in relief.spreads]
    chunks += ["lib/fine_slopes.glsl"] if relief.spreads else []
    return chunks


def aside(layout: ShadingLayout, place: Callable[[int], str]) -> list[str]:
    """Write how many pixels aside all maps are read; `place` gives the footprint of a lookup."""
    parallax = layout.relief.parallax
    if parallax is None:
        return []
    picture = layout.lookups[parallax].picture
    return [
        f"    vec2 aside = parallax_{layout.relief.parallax_method}(picture_{picture}, "
        f"{place(parallax)}, {_how(parallax)}, parallax_reach(point, vertex_normal));"
    ]


def tilts(
    relief: ReliefLayout, read: Callable[[int], list[str]], place: Callable[[int], str]
) -> list[str]:
    """Write how the normal leans.

    Args:
        relief: What there is.
        read: Gives the lines that read a lookup's texel.
        place: Gives the footprint of a lookup.
    """
    lines = []
    if relief.normal is not None:
        tilted = _NORMALS[relief.normal_space][1]
        held = f"held_normal(texel_{relief.normal})"
        lines += read(relief.normal)
        lines.append(f"    point.normal = {tilted}(point, vertex_normal, {held});")
    if relief.roughened_by_normal:
        mean = f"texel_{relief.normal}.xyz"
        lines.append(f"    slope_variance += variance_of_normals({mean});")
    leans = []
    if relief.bump is not None:
        lines += read(relief.bump)
        leans.append(f"bump_lean(point, outer_of(point), texel_{relief.bump}.xy)")
    if relief.roughened_by_bump:
        moments = f"texel_{relief.bump}.xyz"
        lines.append(f"    slope_variance += variance_of_bumps({moments});")
    if relief.height is not None:
        lines += read(relief.height)
        number = relief.height
        leans.append(
            f"height_lean(point, outer_of(point), texel_{number}.x, height_changes("
            f"texel_{number}.yz, look_up({place(number)}, {_how(number)}), "
            f"lookup_period[{number}]))"
        )
    for spread in relief.spreads:
        lines += [*read(spread.products), _spreading(spread, place)]
    if leans:
        lines.append(f"    point.normal = leaned(point.normal, {' + '.join(leans)});")
    return lines


def _spreading(spread: Spread, place: Callable[[int], str]) -> str:
    number, means = spread.means, "yz" if spread.of == "height" else "xy"
    normal = "vertex_normal" if spread.of == "normal" else "outer_of(point)"
    looked = f", look_up({place(number)}, {_how(number)}), lookup_period[{number}]"
    ways = f"{spread.of}_ways(point, {normal}{looked if spread.of == 'height' else ''})"
    covariance = f"covariance_of(texel_{spread.products}.xyz, texel_{number}.{means})"
    spreads = f"spread_along({ways}, {covariance})"
    if spread.streaks:
        return f"    slope_covariance += {spreads};"
    return f"    slope_variance += even_variance({spreads});"


def _how(number: int) -> str:
    return f"lookup_transform[{number}], lookup_period[{number}], lookup_size[{number}]"
