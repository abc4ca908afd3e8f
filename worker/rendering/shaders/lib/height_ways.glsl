#include "lib/height_map.glsl"

// What a relief's slopes per tile add to the unit outer normal, in world axes, as Blinn has it:
// (P_x + h_x n) x (P_y + h_y n), over P_x x P_y . n.
mat2x3 height_ways(SurfacePoint point, vec3 normal, Lookup at, vec4 period) {
    Patch surface = patch_at(point, normal);
    if (!(abs(surface.area) > 0.0)) return mat2x3(0.0);
    mat2x3 leans = mat2x3(
        cross(surface.normal, surface.across_y), cross(surface.across_x, surface.normal)
    ) / surface.area;
    vec2 along_u = height_changes(vec2(1.0, 0.0), at, period);
    vec2 along_v = height_changes(vec2(0.0, 1.0), at, period);
    mat3 in_world = normal_from_object / length(normal_from_object * surface.normal);
    return in_world * leans * mat2(along_u, along_v);
}
