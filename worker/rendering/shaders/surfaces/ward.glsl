#include "lib/fine_relief.glsl"
#include "lib/lights.glsl"
#include "lib/power.glsl"
#include "lib/scratches.glsl"
#include "lib/streak.glsl"
#include "lib/stretched.glsl"
#include "lib/surface_point.glsl"

struct Surface {
    vec3 diffuse_color;
    vec3 specular_color;
    float roughness_along;
    float roughness_across;
    float angle;
    vec3 emission;
};

const float PI = 3.14159265;
const float SMOOTHEST = 1e-3;

// Ward 1992, equation 5a, times cos i, with h left long: tan^2 d cos^2 p = (h.x / h.n)^2.
// Of light from all around rs comes back as a mirror's, blurred to the same slopes.
vec4 shade(SurfacePoint point, Surface surface) {
    float reach = reach_to(reflect(-point.view, point.normal));
    vec3 matt = surface.diffuse_color * point.color.rgb;
    vec3 gloss = surface.specular_color;
    if (point.normal == vec3(0.0)) return vec4(surface.emission + matt, 1.0);
    Scratches axes = scratches(point, surface.angle);
    vec2 slope = max(vec2(surface.roughness_along, surface.roughness_across), SMOOTHEST);
    Widths widths = stretched(vec2(widened(slope.x), widened(slope.y)), axes);
    slope = widths.along;
    axes = widths.axes;
    float seen = max(dot(point.normal, point.view), 1e-4);
    vec3 even = light_all_around();
    vec3 radiance = surface.emission + matt * (even + sky_on_matt(point.normal));
    radiance += gloss * (even + sky_in_streak(point, axes, slope, true, reach));
    for (int i = 0; i < light_total(); i++) {
        Light light = light_at(i, point);
        float facing = dot(point.normal, light.direction);
        if (facing <= 0.0) continue;
        vec3 half_way = light.direction + point.view;
        vec2 lean = vec2(dot(half_way, axes.along), dot(half_way, axes.across));
        lean /= slope * max(dot(half_way, point.normal), 1e-6);
        float lobe = exact_exp2(-1.44269504 * dot(lean, lean));
        float peak = lobe * sqrt(facing / seen) / (4.0 * PI * slope.x * slope.y);
        radiance += (matt * facing / PI + gloss * peak) * light.irradiance;
    }
    return vec4(radiance, 1.0);
}

vec3 albedo(Surface surface) {
    return surface.diffuse_color + surface.specular_color;
}
