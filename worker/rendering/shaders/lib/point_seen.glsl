#include "lib/picture.glsl"
#include "lib/surface_point.glsl"
in vec3 vertex_normal;
in vec4 vertex_tangent;
in vec4 vertex_color;
uniform vec4 eye;  // (0, 0, 0, 1), or the direction towards an orthographic camera and 0

// What is seen at a place, with what the vertices say besides. Both sides of a surface are lit: the
// normal is turned to the side that is seen.
SurfacePoint point_seen(vec3 position, vec3 object_position, vec2 uv[4]) {
    vec3 outer = vertex_normal == vec3(0.0) ? vec3(0.0) : normalize(vertex_normal);
    vec3 normal = gl_FrontFacing ? outer : -outer;
    return SurfacePoint(
        position,
        object_position,
        normal,
        normal,
        outer,
        normalize(eye.xyz - eye.w * position),
        vertex_tangent,
        vertex_color,
        uv
    );
}
