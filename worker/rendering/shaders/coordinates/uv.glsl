#include "lib/surface_point.glsl"

// The coordinates that come with the mesh, interpolated perspective-correctly.
vec2 coordinates_uv(SurfacePoint point) {
    return point.uv;
}
