#include "lib/level_of_detail.glsl"

// Bilinear in the two levels round lambda, blended (Williams 1983).
vec4 sample_trilinear(sampler2D picture, Lookup at) {
    return textureLod(picture, at.place, level_of_detail(at));
}
