#include "lib/disc.glsl"

// What two parabolic mirrors show (Heidrich and Seidel 1998): (x, y) / (1 + |z|).
Footprint layout_dual_paraboloid(Reach direction, const int second) {
    return disc_pair(direction, 2, second);
}
