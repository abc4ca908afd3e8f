#include "lib/picture.glsl"
#include "lib/surface_point.glsl"
in vec3 vertex_position;
in vec3 vertex_object_position;
in vec3 vertex_normal;
in vec4 vertex_tangent;
in vec4 vertex_color;
in vec2 vertex_uv_0;
in vec2 vertex_uv_1;
in vec2 vertex_uv_2;
in vec2 vertex_uv_3;
uniform vec4 eye;  // (0, 0, 0, 1), or the direction towards an orthographic camera and 0

float inverse_w() {
    return gl_FragCoord.w;
}

// Both sides of a surface are lit: the normal is turned to the side that is seen.
SurfacePoint surface_point() {
    vec3 outer = vertex_normal == vec3(0.0) ? vec3(0.0) : normalize(vertex_normal);
    vec3 normal = gl_FrontFacing ? outer : -outer;
    return SurfacePoint(
        vertex_position,
        vertex_object_position,
        normal,
        normal,
        outer,
        normalize(eye.xyz - eye.w * vertex_position),
        vertex_tangent,
        vertex_color,
        vec2[4](vertex_uv_0, vertex_uv_1, vertex_uv_2, vertex_uv_3)
    );
}
