#include "lib/surface_point.glsl"

struct Surface {
    vec3 color;
};

// Shines by itself: L_out = color, times the mesh's.
vec4 shade(SurfacePoint point, Surface surface) {
    return vec4(surface.color * point.color.rgb, 1.0);
}

vec3 albedo(Surface surface) {
    return surface.color;
}
