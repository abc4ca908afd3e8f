#include "lib/power.glsl"
#include "lib/upright_reach.glsl"

// The picture that is halved level.x times along u and level.y times along v lies in the table at
// the sum of the widths and heights before it, each with a frame of one texel on either side. Those
// sums of floor(n / 2^k) are Legendre's: 2 n - (ones in the binary n) for all k.
vec4 ripmap_reading(sampler2D table, Lookup at, vec2 place, ivec2 level) {
    ivec2 whole = ivec2(at.size);
    ivec2 smaller = whole >> level;
    ivec2 before = 2 * (whole - smaller) - bitCount(whole) + bitCount(smaller) + 2 * level;
    vec2 side = vec2(max(smaller, 1));
    vec2 texel = clamp(place * side, vec2(-0.5), side + 0.5) + vec2(before) + 1.0;
    return textureLod(table, texel / vec2(textureSize(table, 0)), 0.0);
}

// The mean of the rectangle round the pixel: bilinear in the pictures next in width and in height,
// blended.
vec4 sample_ripmap(sampler2D table, Lookup at) {
    vec2 folded = 1.0 - abs(1.0 - at.place);
    vec2 place = mix(at.place, folded, equal(at.period, vec2(2.0)));
    vec2 reach = upright_reach(at);
    vec2 coarsest = vec2(findMSB(ivec2(at.size)));
    vec2 level = min(vec2(exact_log2(reach.x), exact_log2(reach.y)), coarsest);
    ivec2 low = ivec2(level), high = min(low + 1, ivec2(coarsest));
    vec2 blend = level - vec2(low);
    vec4 lower = mix(
        ripmap_reading(table, at, place, low),
        ripmap_reading(table, at, place, ivec2(high.x, low.y)),
        blend.x
    );
    vec4 upper = mix(
        ripmap_reading(table, at, place, ivec2(low.x, high.y)),
        ripmap_reading(table, at, place, high),
        blend.x
    );
    return mix(lower, upper, blend.y);
}
