#include "lib/lookup.glsl"

const float LARGEST_REACH = 1e6;

// Width and height in texels of the upright rectangle round the ellipse that a pixel covers, at
// least a texel each; what is not finite counts as very large.
vec2 upright_reach(Lookup at) {
    vec2 reach = vec2(
        length(vec2(at.across_x.x, at.across_y.x)), length(vec2(at.across_x.y, at.across_y.y))
    );
    return max(mix(vec2(LARGEST_REACH), reach, lessThan(reach, vec2(LARGEST_REACH))), 1.0);
}
