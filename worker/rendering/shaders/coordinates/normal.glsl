#include "lib/frames.glsl"

// The normal, tilted where there is a normal map.
Reach coordinates_normal(SurfacePoint point, const int frame) {
    return normal_in(point.normal, frame);
}
