#include "lib/level_of_detail.glsl"

const int MOST_PROBES = 16;

// Trilinear probes in a row along the footprint's longer axis, as fine as its shorter axis
// (McCormack et al. 1999, Feline). The axes are the singular vectors of the footprint's Jacobian,
// so that the result does not depend on how the footprint lies to the pixel grid.
vec4 sample_anisotropic(sampler2D picture, Lookup at) {
    vec2 larger = max(abs(at.across_x), abs(at.across_y));
    float unit = max(larger.x, larger.y);
    if (!(unit < 1e18)) return textureLod(picture, at.place, COARSEST);
    if (unit <= 0.5) return textureLod(picture, at.place, 0.0);

    vec2 x = at.across_x / unit, y = at.across_y / unit;
    float uu = x.x * x.x + y.x * y.x, uv = x.x * x.y + y.x * y.y, vv = x.y * x.y + y.y * y.y;
    float half_difference = 0.5 * (uu - vv);
    float major_squared = 0.5 * (uu + vv) + sqrt(half_difference * half_difference + uv * uv);
    float major = unit * sqrt(major_squared);
    float minor = unit * abs(x.x * y.y - x.y * y.x) / sqrt(major_squared);
    vec2 axis = uu >= vv ? vec2(major_squared - vv, uv) : vec2(uv, major_squared - uu);
    float bias = length(axis);  // 0 for a round footprint, which has no longer axis
    vec2 stretch = bias > 0.0 ? axis * (major / bias) / at.size : vec2(0.0);

    float width = max(max(minor, major / float(MOST_PROBES)), 1.0);
    int probes = clamp(int(ceil(major / width)), 1, MOST_PROBES);
    float level = level_for(width);
    vec4 mean = vec4(0.0);
    for (int i = 0; i < probes; i++) {
        float t = (float(i) + 0.5) / float(probes) - 0.5;
        vec4 texel = textureLod(picture, at.place + t * stretch, level);
        // A running mean keeps a constant picture constant to the last bit; a sum would not.
        mean += (texel - mean) / float(i + 1);
    }
    return mean;
}
