#include "lib/reach.glsl"
#include "lib/surface_point.glsl"

// The coordinates that come with the mesh, interpolated perspective-correctly.
Footprint coordinates_uv(SurfacePoint point, const int set) {
    return flat_reach(reach_of(vec3(point.uv[set], 0.0)));
}
