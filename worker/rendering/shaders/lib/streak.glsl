#include "lib/scratches.glsl"
#include "lib/sky.glsl"

const int STREAK_MIRRORS = 12;

// What of the sky a surface shows whose little mirrors lean further along one axis than along the
// other: the mean of round lobes as wide as the narrow side, whose mirrors lean along the wide one.
// Leans are quantiles of the slopes seen from the side: of GGX p = a x / sqrt(1 - x^2), of a Gaussian
// about 0.89 a x / (1 - x^2)^(1/4). Widths of GGX add up, as Cauchy's do, those of Gaussians by their
// squares; a round lobe of these is most like one of GGX with 0.7 a, which has longer tails. What
// mirror p shows counts as far as it is seen, v.(n + p t), and lit by what it shows. A lobe is no
// narrower than the way to its neighbours, so that they join.
//   alpha: width along and across; equal ones are one round lobe
//   gaussian: whether slopes are so distributed, or as in GGX
//   reach: how far the mirrored direction changes from pixel to pixel
vec3 sky_in_streak(SurfacePoint point, Scratches axes, vec2 alpha, bool gaussian, float reach) {
    vec3 way = alpha.x >= alpha.y ? axes.along : axes.across;
    float wide = max(alpha.x, alpha.y), narrow = min(alpha.x, alpha.y);
    float spread = gaussian ? sqrt(max(wide * wide - narrow * narrow, 0.0)) : wide - narrow;
    narrow *= gaussian ? 0.7 : 1.0;
    int mirrors = spread > 0.0 ? STREAK_MIRRORS : 1;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < mirrors; i++) {
        float x = float(2 * i + 1) / float(mirrors) - 1.0;
        float steep = inversesqrt(1.0 - x * x);
        float lean = spread * x * (gaussian ? 0.89 * sqrt(steep) : steep);
        vec3 mirror = point.normal + lean * way;
        float seen = dot(mirror, point.view);
        mirror *= inversesqrt(1.0 + lean * lean);
        vec3 towards = reflect(-point.view, mirror);
        float weight = max(seen, 0.0) * max(dot(towards, point.normal), 0.0);
        float gap = steep * steep * (gaussian ? 0.89 * sqrt(steep) * (1.0 - 0.5 * x * x) : steep);
        vec2 width = vec2(gaussian ? narrow : narrow * steep, spread * gap / float(mirrors));
        float rough = sqrt(min(length(width), 1.0));
        sum += weight * sky_in_mirror(towards, reach, rough);
        weights += weight;
    }
    return sum / max(weights, 1e-20);
}
