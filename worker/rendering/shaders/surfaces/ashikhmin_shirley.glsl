#include "lib/fine_relief.glsl"
#include "lib/lights.glsl"
#include "lib/microfacets.glsl"
#include "lib/power.glsl"
#include "lib/scratches.glsl"
#include "lib/streak.glsl"
#include "lib/stretched.glsl"
#include "lib/surface_point.glsl"

struct Surface {
    vec3 diffuse_color;
    vec3 specular_color;
    float exponent_along;
    float exponent_across;
    float angle;
    vec3 emission;
};

const float PI = 3.14159265;

// Ashikhmin and Shirley 2000, equations 1 to 5, times n.k1. The power of n.h is one of tan^2 d:
// (nu (h.u)^2 + nv (h.v)^2) / (1 - (n.h)^2), which at h = n is 0 / 0 and harmless as (n.h)^x = 1.
// Of light from all around the matt part returns Rd (1 - Rs) (1 - (1 - n.v / 2)^5), which is its
// integral, and the glossy one F of what it mirrors; slopes as wide as (n.h)^e has them are
// alpha^2 = 2 / (e + 2).
vec4 shade(SurfacePoint point, Surface surface) {
    float reach = reach_to(reflect(-point.view, point.normal));
    vec3 gloss = clamp(surface.specular_color, 0.0, 1.0);
    vec3 matt = surface.diffuse_color * point.color.rgb * (1.0 - gloss);
    if (point.normal == vec3(0.0)) return vec4(surface.emission + matt, 1.0);
    Scratches axes = scratches(point, surface.angle);
    vec2 exponent = max(vec2(surface.exponent_along, surface.exponent_across), 0.0);
    exponent = vec2(dulled(exponent.x), dulled(exponent.y));
    Widths widths = stretched(sqrt(2.0 / max(exponent, 1e-6)), axes);
    if (slope_covariance != mat3(0.0)) exponent = 2.0 / (widths.along * widths.along);
    axes = widths.axes;
    float strength = sqrt((exponent.x + 1.0) * (exponent.y + 1.0)) / (8.0 * PI);
    float seen = max(dot(point.normal, point.view), 1e-4);
    float matt_seen = 1.0 - schlick(0.5 * seen);
    vec3 even = light_all_around();
    vec3 radiance = surface.emission + matt * matt_seen * (even + sky_on_matt(point.normal));
    vec2 width = sqrt(2.0 / (exponent + 2.0));
    vec3 in_mirror = even + sky_in_streak(point, axes, width, true, reach);
    radiance += (gloss + (1.0 - gloss) * schlick(seen)) * in_mirror;
    for (int i = 0; i < light_total(); i++) {
        Light light = light_at(i, point);
        float facing = dot(point.normal, light.direction);
        if (facing <= 0.0) continue;
        vec3 half_way = normalize(light.direction + point.view);
        vec2 lean = vec2(dot(half_way, axes.along), dot(half_way, axes.across));
        float upright = clamp(dot(half_way, point.normal), 0.0, 1.0);
        vec3 sine = cross(half_way, point.normal);
        float power = dot(exponent, lean * lean) / max(dot(sine, sine), 1e-12);
        float met = max(dot(half_way, point.view), 1e-4);
        float peak = strength * exact_power(upright, power) / (met * max(facing, seen));
        vec3 fresnel = gloss + (1.0 - gloss) * schlick(met);
        vec3 below = matt * (28.0 / (23.0 * PI) * matt_seen * (1.0 - schlick(0.5 * facing)));
        radiance += (below + fresnel * peak) * (facing * light.irradiance);
    }
    return vec4(radiance, 1.0);
}

vec3 albedo(Surface surface) {
    return surface.diffuse_color + surface.specular_color;
}
