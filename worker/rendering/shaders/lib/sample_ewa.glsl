#include "lib/level_of_detail.glsl"

const float MOST_ELONGATED = 16.0;
const float WIDEST = 34.0;         // semi-axes of an ellipse in texels of its level
const float TEXEL_SPREAD = 1.0 / 3.0;  // of a texel as an ellipse: its squared semi-axes

// The texels that a pixel covers: A u^2 + B u v + C v^2 < F, u and v in texels from its middle.
struct Ellipse {
    float a, b, c, f;
};

// The image of the unit circle under the footprint (Heckbert 1989).
Ellipse ellipse_of(vec2 across_x, vec2 across_y) {
    float area = across_x.x * across_y.y - across_x.y * across_y.x;
    return Ellipse(
        across_x.y * across_x.y + across_y.y * across_y.y,
        -2.0 * (across_x.x * across_x.y + across_y.x * across_y.y),
        across_x.x * across_x.x + across_y.x * across_y.x,
        area * area
    );
}

// Its semi-axes: the longer one's direction and both lengths.
struct Axes {
    vec2 along;
    float major, minor;
};

// Of a footprint whose largest number is 1.
Axes axes_of(vec2 across_x, vec2 across_y) {
    Ellipse ellipse = ellipse_of(across_x, across_y);
    float half_difference = 0.5 * (ellipse.c - ellipse.a);
    float reach = length(vec2(half_difference, 0.5 * ellipse.b));
    float major = sqrt(0.5 * (ellipse.a + ellipse.c) + reach);
    vec2 along = half_difference >= 0.0
        ? vec2(half_difference + reach, -0.5 * ellipse.b)
        : vec2(-0.5 * ellipse.b, reach - half_difference);
    // A circle has no longer axis: any will do.
    return Axes(reach > 1e-12 ? normalize(along) : vec2(1.0, 0.0), major, sqrt(ellipse.f) / major);
}

// A Gaussian over the ellipse, exp(-2 Q / F), Q = A u^2 + B u v + C v^2 (Greene and Heckbert 1986),
// row by row in the level where the shorter semi-axis is one to two texels long. Ellipses more than
// 16 times as long as wide are widened. One that is empty or not finite reads as trilinear.
vec4 sample_ewa(sampler2D picture, Lookup at) {
    vec2 larger = max(abs(at.across_x), abs(at.across_y));
    float unit = max(larger.x, larger.y);
    if (!(unit > 1e-18 && unit < 1e18)) return textureLod(picture, at.place, level_of_detail(at));
    Axes axes = axes_of(at.across_x / unit, at.across_y / unit);
    float major = max(unit * axes.major, 1.0);
    float minor = max(max(unit * axes.minor, major / MOST_ELONGATED), 1.0);
    int coarsest = findMSB(int(max(at.size.x, at.size.y)));
    float level = floor(level_for(minor));
    if (level >= float(coarsest)) return textureLod(picture, at.place, float(coarsest));

    // In texels of the level, each of which is spread already by the box that it is the mean of.
    float texel = exact_exp2(level);
    major = sqrt(major * major - TEXEL_SPREAD * texel * texel);
    minor = sqrt(minor * minor - TEXEL_SPREAD * texel * texel);
    vec2 side = vec2(textureSize(picture, int(level)));
    vec2 shrink = side / at.size;
    vec2 x = major * axes.along * shrink;
    vec2 y = minor * vec2(-axes.along.y, axes.along.x) * shrink;
    vec2 reach = vec2(length(vec2(x.x, y.x)), length(vec2(x.y, y.y)));
    vec2 bounded = min(reach, WIDEST);  // pictures of few rows have no smaller level
    x *= bounded / reach;
    y *= bounded / reach;
    Ellipse ellipse = ellipse_of(x, y);
    vec2 middle = at.place * side - 0.5;
    vec4 mean = vec4(0.0);
    float total = 0.0;
    float last_row = floor(middle.y + bounded.y);
    for (float row = ceil(middle.y - bounded.y); row <= last_row; row++) {
        float v = row - middle.y;
        float start = -0.5 * ellipse.b * v / ellipse.a;
        float rest = start * start - (ellipse.c * v * v - ellipse.f) / ellipse.a;
        float half_width = sqrt(max(rest, 0.0));
        float last = floor(middle.x + start + half_width);
        for (float column = ceil(middle.x + start - half_width); column <= last; column++) {
            float u = column - middle.x;
            float q = (ellipse.a * u + ellipse.b * v) * u + ellipse.c * v * v;
            float weight = exp(-2.0 * q / ellipse.f);
            total += weight;
            // A running mean keeps a constant picture constant to the last bit; a sum would not.
            vec4 here = textureLod(picture, (vec2(column, row) + 0.5) / side, level);
            mean += (here - mean) * (weight / total);
        }
    }
    return mean;
}
