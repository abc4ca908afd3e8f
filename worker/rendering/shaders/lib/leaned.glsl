#include "lib/surface_point.glsl"

// The smooth unit normal on the outer side.
vec3 outer_of(SurfacePoint point) {
    return gl_FrontFacing ? point.smooth_normal : -point.smooth_normal;
}

// The normal on the eye's side, tilted further by what is added to it on the outer side.
vec3 leaned(vec3 normal, vec3 lean) {
    vec3 outer = (gl_FrontFacing ? normal : -normal) + lean;
    vec3 size = abs(outer);
    outer /= max(size.x, max(size.y, size.z));  // lest the square of a large one is infinite
    float squared = dot(outer, outer);
    if (!(squared > 0.0)) return normal;
    outer *= inversesqrt(squared);
    return gl_FrontFacing ? outer : -outer;
}
