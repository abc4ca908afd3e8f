#include "lib/fine_relief.glsl"
#include "lib/lights.glsl"
#include "lib/phong_lobe.glsl"
#include "lib/power.glsl"
#include "lib/scratches.glsl"
#include "lib/sky.glsl"
#include "lib/surface_point.glsl"

struct Surface {
    vec3 diffuse_color;
    vec3 specular_color;
    float exponent;
    float along;
    float across;
    float angle;
    vec3 emission;
};

// L_out = emission + Ca La + sum_l [Cd max(0, n.l) + Cs max(0, r^T M v)^n] L_l with
// M = V diag(s, t, 1) V^T, V = [t1 t2 n] (Hughes et al. 2013, exercise 20.1): s = t = 1 is Phong's.
// For all light at once r^T M v is |M v| times a cosine: Phong's lobe of an eye in direction M v.
vec4 shade(SurfacePoint point, Surface surface) {
    Scratches axes = scratches(point, surface.angle);
    vec2 kept = clamp(vec2(surface.along, surface.across), 0.0, 1.0);
    // M v: what r is multiplied by.
    vec3 mapped_view = kept.x * dot(axes.along, point.view) * axes.along
        + kept.y * dot(axes.across, point.view) * axes.across
        + dot(point.normal, point.view) * point.normal;
    float size = length(mapped_view);
    vec3 seen_mirrored = reflect(-mapped_view / max(size, 1e-20), point.normal);
    float reach = reach_to(seen_mirrored);
    vec3 matt = surface.diffuse_color * point.color.rgb;
    if (point.normal == vec3(0.0)) return vec4(surface.emission + matt, 1.0);
    float own_exponent = max(surface.exponent, 0.0);
    float exponent = dulled_mirror(own_exponent);
    vec3 gloss = surface.specular_color * ((exponent + 1.0) / (own_exponent + 1.0));
    vec3 on_matt = light_all_around() + sky_on_matt(point.normal);
    vec3 radiance = surface.emission + matt * on_matt;
    radiance += surface.specular_color * exact_power(min(size, 1.0), own_exponent)
        * sky_in_mirror(seen_mirrored, reach, roughness_of(exponent));
    for (int i = 0; i < light_total(); i++) {
        Light light = light_at(i, point);
        float facing = dot(point.normal, light.direction);
        if (facing <= 0.0) continue;
        vec3 mirrored = 2.0 * facing * point.normal - light.direction;
        float highlight = exact_power(clamp(dot(mirrored, mapped_view), 0.0, 1.0), exponent);
        radiance += (matt * facing + gloss * highlight) * light.irradiance;
    }
    return vec4(radiance, 1.0);
}

vec3 albedo(Surface surface) {
    return surface.diffuse_color + surface.specular_color;
}
