#include "lib/leaned.glsl"
#include "lib/lookup.glsl"
#include "lib/relief.glsl"
uniform float height_depth;
uniform float height_middle;
uniform bool height_exact;

// How much the height changes to the next pixels: its slopes are per tile, and copies that are
// mirrored (period 2) fall where the picture rises.
vec2 height_changes(vec2 slopes, Lookup at, vec4 period) {
    bvec2 mirrored = bvec2(period.x == 2.0 && at.place.x >= 1.0, period.y == 2.0 && at.place.y >= 1.0);
    vec2 rise = mix(slopes, -slopes, mirrored) / at.size;
    return height_depth * vec2(dot(rise, at.across_x), dot(rise, at.across_y));
}

// What a relief adds to the unit outer normal, in world axes (Blinn 1978). Of P' = P + h n,
//   P'_x = P_x + h_x n + h n_x and the same for y, and N' = P'_x x P'_y, on the side of n;
// his approximation leaves h n_x out. The pixel's own steps serve as parameters.
vec3 height_lean(SurfacePoint point, vec3 normal, float texel, vec2 changes) {
    Patch surface = patch_at(point, normal);
    vec3 x = surface.across_x + changes.x * surface.normal;
    vec3 y = surface.across_y + changes.y * surface.normal;
    if (height_exact) {
        float height = height_depth * (texel - height_middle);
        Reach turning = reach_of(surface.normal);
        x += height * laid(turning.across_x, surface.normal);
        y += height * laid(turning.across_y, surface.normal);
    }
    vec3 raised = cross(x, y) * sign(surface.area);
    float facing = dot(raised, surface.normal);
    if (!(facing > 0.0)) return vec3(0.0);  // folded over, or seen from its edge
    vec3 lean = raised / facing - surface.normal;
    return normal_from_object * lean / length(normal_from_object * surface.normal);
}
