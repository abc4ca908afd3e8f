#include "lib/frames.glsl"

// Snell's law at the one surface that is seen, from outside into the glass or from inside out of it.
Reach coordinates_refraction(SurfacePoint point, float ior, const int frame) {
    vec3 bent = refract(-point.view, point.normal, gl_FrontFacing ? 1.0 / ior : ior);
    return direction_in(bent == vec3(0.0) ? reflect(-point.view, point.normal) : bent, frame);
}
