#include "lib/frames.glsl"

// From the eye to the point, and on.
Reach coordinates_view(SurfacePoint point, const int frame) {
    return direction_in(-point.view, frame);
}
