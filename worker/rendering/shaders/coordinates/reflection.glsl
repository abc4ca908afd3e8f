#include "lib/frames.glsl"

// r = 2 (n.v) n - v (Blinn and Newell 1976).
Reach coordinates_reflection(SurfacePoint point, const int frame) {
    return direction_in(reflect(-point.view, point.normal), frame);
}
