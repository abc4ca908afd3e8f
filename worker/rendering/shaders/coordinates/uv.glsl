#include "lib/footprint.glsl"
#include "lib/surface_point.glsl"

// The coordinates that come with the mesh, interpolated perspective-correctly. uv / w and 1 / w are
// linear on the screen, so that their differences between pixels are derivatives, and the quotient
// rule gives those of uv at this very pixel (Heckbert 1989); a plain difference of uv would be one
// between two pixels.
Footprint coordinates_uv(SurfacePoint point, int set) {
    vec2 uv = point.uv[set];
    float inverse = inverse_w();
    vec2 scaled = uv * inverse;
    return Footprint(
        uv,
        (dFdx(scaled) - uv * dFdx(inverse)) / inverse,
        (dFdy(scaled) - uv * dFdy(inverse)) / inverse
    );
}
