#include "lib/disc.glsl"

// Above and below, seen from far away (Hughes et al. 2013, 20.4): x to the right, z up.
Footprint layout_hemispheres(Reach direction, const int second) {
    Reach local = Reach(
        direction.place.xzy, direction.across_x.xzy, direction.across_y.xzy
    );
    return disc_pair(local, 3, second);
}
