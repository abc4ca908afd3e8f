#include "lib/point_seen.glsl"
in vec3 vertex_position;
in vec3 vertex_object_position;
in vec2 vertex_uv_0;
in vec2 vertex_uv_1;
in vec2 vertex_uv_2;
in vec2 vertex_uv_3;

SurfacePoint surface_point() {
    return point_seen(
        vertex_position,
        vertex_object_position,
        vec2[4](vertex_uv_0, vertex_uv_1, vertex_uv_2, vertex_uv_3)
    );
}
