#include "lib/disc.glsl"

// A mirrored ball seen from +z from far away (Miller and Hoffman 1984): sin(a/2) from the middle.
Footprint layout_mirror_ball(Reach direction) {
    return disc_picture(direction, 1, DISC_HALF);
}
