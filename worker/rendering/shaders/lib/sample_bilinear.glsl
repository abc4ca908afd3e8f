#include "lib/lookup.glsl"

// The four texels round the place, weighted by nearness; smooth when near, not when far.
vec4 sample_bilinear(sampler2D picture, Lookup at) {
    return textureLod(picture, at.place, 0.0);
}
