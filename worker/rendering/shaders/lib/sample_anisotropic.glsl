#include "lib/level_of_detail.glsl"

const int MOST_PROBES = 16;

// Trilinear probes in a row along the footprint's longer axis, as fine as its shorter axis
// (McCormack et al. 1999, Feline). The axes are the singular vectors of the footprint's Jacobian,
// so that the result does not depend on how the footprint lies to the pixel grid.
vec4 sample_anisotropic(sampler2D picture, Lookup at) {
    vec2 larger = max(abs(at.across_x), abs(at.across_y));
    float unit = max(larger.x, larger.y);
    bool usable = unit > 0.0 && unit < 1e18;
    vec2 x = usable ? at.across_x / unit : vec2(1.0, 0.0);
    vec2 y = usable ? at.across_y / unit : vec2(0.0, 1.0);
    float uu = x.x * x.x + y.x * y.x, uv = x.x * x.y + y.x * y.y, vv = x.y * x.y + y.y * y.y;
    float half_difference = 0.5 * (uu - vv);
    float major_squared = 0.5 * (uu + vv) + sqrt(half_difference * half_difference + uv * uv);
    float major = unit * sqrt(major_squared);
    float minor = unit * abs(x.x * y.y - x.y * y.x) / sqrt(major_squared);
    vec2 axis = uu >= vv ? vec2(major_squared - vv, uv) : vec2(uv, major_squared - uu);
    // A round footprint has no longer axis, and yet rounding may find two probes for it.
    float axis_length = max(length(axis), 1e-30);

    float width = max(max(minor, major / float(MOST_PROBES)), 1.0);
    int probes = usable ? clamp(int(ceil(major / width)), 1, MOST_PROBES) : 1;
    vec2 stretch = probes > 1 ? axis * (major / axis_length) / at.size : vec2(0.0);
    // A reading is a box of texels blurred by a tent as wide: half a level finer comes nearer to
    // the box wanted (RMS on the checkered plane .0146 instead of .0161).
    float level = unit < 1e18 ? level_for(width * 0.70710678) : COARSEST;
    vec4 mean = vec4(0.0);
    for (int i = 0; i < probes; i++) {
        float t = (float(i) + 0.5) / float(probes) - 0.5;
        vec4 texel = textureLod(picture, at.place + t * stretch, level);
        // A running mean keeps a constant picture constant to the last bit; a sum would not.
        mean += (texel - mean) / float(i + 1);
    }
    return mean;
}
