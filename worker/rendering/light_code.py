"""Generated code of lit surfaces: what part of a light comes through, for the lights of a scene."""

from worker.rendering.lookup_fragment import SAMPLERS
from worker.rendering.shading_layout import CookieLayout, LightLayout

_LAMPS_ALONE = (
    "int light_total() { return light_count; }",
    "Light light_at(int index, SurfacePoint point) { return lamp_let_through(index, point); }",
)
_WITH_SKY = (
    "int light_total() { return light_count + sky_lamp_count; }",
    "Light light_at(int index, SurfacePoint point) {",
    "    if (index >= light_count) return sky_lamp(index - light_count);",
    "    return lamp_let_through(index, point);",
    "}",
)


def light_chunks(layout: LightLayout) -> list[str]:
    """Return the chunks that let_through needs."""
    chunks = ["lib/light_visibility.glsl" if layout.visibility else "lib/lights.glsl"]
    chunks += ["lib/shadows.glsl"] if layout.shadows else []
    if layout.cookies:
        chunks.append("lib/cookies.glsl")
    for cookie in layout.cookies:
        chunks += [] if cookie.call is None else [cookie.call.chunk]
        flat = cookie.picture.format.kind == "picture"
        chunks.append(f"lib/sample_{cookie.filter if flat else 'space'}.glsl")
    return chunks


def light_lines(layout: LightLayout) -> list[str]:
    """Write what lib/lights.glsl asks; without shadows and cookies all light comes through."""
    count = len(layout.cookies)
    declared = []
    for name, cookie in zip(layout.samplers, layout.cookies, strict=True):
        declared.append(f"uniform {SAMPLERS[cookie.picture.format.kind]} {name};")
        declared += [] if cookie.call is None else cookie.call.declarations(name)
    if count:
        declared += [
            f"uniform vec4 cookie_period[{count}];",
            f"uniform vec2 cookie_size[{count}];",
        ]
    seen = "unshaded(light, point.position, point.smooth_normal)" if layout.shadows else "1.0"
    lines = [
        *declared,
        "float seen_by_light(int light, SurfacePoint point) {",
        f"    return {seen};",
        "}",
        "vec3 let_through(int light, SurfacePoint point) {",
        "    vec3 share = vec3(seen_by_light(light, point));",
    ]
    if count:
        lines.append("    Reach ray = cookie_ray(light, point.position);")
    lines += [
        f"    if (cookie_picture[light] == {number}.0) share *= {_reading(cookie, number)}.rgb;"
        for number, cookie in enumerate(layout.cookies)
    ]
    lines += ["    return share;", "}"]
    return [*lines, *(_WITH_SKY if layout.sky == "lamps" else _LAMPS_ALONE)]


def _reading(cookie: CookieLayout, number: int) -> str:
    name = f"cookie_{number}"
    where = "thrown(ray)" if cookie.call is None else cookie.call.text("ray", name)
    if cookie.picture.format.kind == "picture":
        how = f"mat3(1.0), cookie_period[{number}], cookie_size[{number}]"
        return f"sample_{cookie.filter}({name}, look_up({where}, {how}))"
    return f"sample_{cookie.filter}({name}, look_up_cube({where}, cookie_size[{number}].x))"
