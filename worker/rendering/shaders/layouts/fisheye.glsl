#include "lib/disc.glsl"
#include "lib/picture_axes.glsl"

// A lens with a very wide angle, by one of the four models of lens makers.
Footprint layout_fisheye(Reach direction, const int model, float angle, const int towards) {
    return disc_picture(in_picture(direction, towards), model, 0.5 * angle);
}
