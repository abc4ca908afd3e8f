#include "lib/disc.glsl"

// The distance from the middle is the angle from -z, or from +z; x is to the right (Debevec 1998).
Footprint layout_angular_probe(Reach direction, const int centre) {
    vec3 side = vec3(1.0, 1.0, centre == 0 ? -1.0 : 1.0);
    Reach local = Reach(
        side * direction.place, side * direction.across_x, side * direction.across_y
    );
    return disc_picture(local, 0, DISC_HALF);
}
