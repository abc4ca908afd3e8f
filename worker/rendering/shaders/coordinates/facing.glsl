#include "lib/reach.glsl"
#include "lib/surface_point.glsl"

// u = (1 + n.r) / 2 with the outer normal, which point.normal is not where the inside is seen.
Footprint coordinates_facing(SurfacePoint point) {
    float facing = dot(point.normal, point.view);
    float u = 0.5 + 0.5 * (gl_FrontFacing ? facing : -facing);
    return flat_reach(difference_of(vec3(u, 0.5, 0.0)));
}
