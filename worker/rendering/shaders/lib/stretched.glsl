#include "lib/fine_relief.glsl"
#include "lib/scratches.glsl"

// A lobe's widths along two axes, as of exp(-tan^2 d / width^2).
struct Widths {
    vec2 along;
    Scratches axes;
};

// A lobe widened by what fine relief adds to the covariance of its slopes, which is width^2 / 2: the
// new axes are those of that ellipse.
Widths stretched(vec2 width, Scratches axes) {
    if (slope_covariance == mat3(0.0)) return Widths(width, axes);
    vec3 along = slope_covariance * axes.along, across = slope_covariance * axes.across;
    float xx = width.x * width.x + 2.0 * dot(axes.along, along);
    float yy = width.y * width.y + 2.0 * dot(axes.across, across);
    float xy = 2.0 * dot(axes.along, across);
    float half_difference = 0.5 * (xx - yy);
    float root = length(vec2(half_difference, xy));
    float larger = 0.5 * (xx + yy) + root;
    float own = min(width.x, width.y);
    float smaller = max((xx * yy - xy * xy) / larger, own * own);
    vec2 way = half_difference >= 0.0
        ? vec2(half_difference + root, xy) : vec2(xy, root - half_difference);
    way = root > 0.0 ? normalize(way) : vec2(1.0, 0.0);
    return Widths(
        sqrt(vec2(larger, smaller)),
        Scratches(way.x * axes.along + way.y * axes.across, way.x * axes.across - way.y * axes.along)
    );
}
