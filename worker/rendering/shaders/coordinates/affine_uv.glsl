#include "lib/footprint.glsl"
#include "lib/surface_point.glsl"
noperspective in vec2 flat_uv_0;
noperspective in vec2 flat_uv_1;
noperspective in vec2 flat_uv_2;
noperspective in vec2 flat_uv_3;

// The coordinates that come with the mesh, interpolated linearly on the screen: wrong in perspective.
Footprint coordinates_affine_uv(SurfacePoint point, const int set) {
    vec2 uv = vec2[4](flat_uv_0, flat_uv_1, flat_uv_2, flat_uv_3)[set];
    return Footprint(uv, dFdx(uv), dFdy(uv));
}
