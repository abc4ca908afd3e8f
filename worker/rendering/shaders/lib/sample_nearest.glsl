#include "lib/lookup.glsl"

// The texel that covers the place.
vec4 sample_nearest(sampler2D picture, Lookup at) {
    return textureLod(picture, at.place, 0.0);
}
