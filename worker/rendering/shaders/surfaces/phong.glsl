#include "lib/fine_relief.glsl"
#include "lib/lights.glsl"
#include "lib/phong_lobe.glsl"
#include "lib/power.glsl"
#include "lib/sky.glsl"
#include "lib/surface_point.glsl"

struct Surface {
    float ambient_weight;
    vec3 ambient_color;
    float diffuse_weight;
    vec3 diffuse_color;
    float specular_weight;
    vec3 specular_color;
    float exponent;
    vec3 emission;
    int normalization;  // 0 none, 1 energy
};

const float PI = 3.14159265;

// L_out = emission + ka Ca La + sum_l [kd Cd max(0, n.l) + ks Cs max(0, r.v)^n] L_l (Phong 1975).
// The mesh's colour multiplies Ca and Cd. A point without a normal shows emission + kd Cd.
// energy: kd / pi, and ks (n + 2) / (2 pi) with the extra n.l (Lafortune and Willems 1994).
vec4 shade(SurfacePoint point, Surface surface) {
    vec3 seen_mirrored = reflect(-point.view, point.normal);
    float reach = reach_to(seen_mirrored);
    // precise: a mapped constant and a plain one must give the same bits in their two programs.
    precise vec3 matt = surface.diffuse_weight * surface.diffuse_color * point.color.rgb;
    precise vec3 gloss = surface.specular_weight * surface.specular_color;
    if (point.normal == vec3(0.0)) return vec4(surface.emission + matt, 1.0);
    float own_exponent = max(surface.exponent, 0.0);  // a map may go below, the model does not
    float exponent = dulled_mirror(own_exponent);
    if (surface.normalization == 1) {
        matt /= PI;
        gloss *= (exponent + 2.0) / (2.0 * PI);
    } else {
        gloss *= (exponent + 1.0) / (own_exponent + 1.0);  // as bright in all
    }
    precise vec3 ambient = surface.ambient_weight * surface.ambient_color * point.color.rgb;
    vec3 on_matt = light_all_around() + sky_on_matt(point.normal);
    precise vec3 radiance = surface.emission + ambient * on_matt;
    radiance += surface.specular_weight * surface.specular_color
        * sky_in_mirror(seen_mirrored, reach, roughness_of(exponent));
    for (int i = 0; i < light_total(); i++) {
        Light light = light_at(i, point);
        float facing = dot(point.normal, light.direction);
        if (facing <= 0.0) continue;
        vec3 mirrored = 2.0 * facing * point.normal - light.direction;
        float highlight = exact_power(clamp(dot(mirrored, point.view), 0.0, 1.0), exponent);
        if (surface.normalization == 1) highlight *= facing;
        precise vec3 reflected = matt * facing + gloss * highlight;
        radiance += reflected * light.irradiance;
    }
    return vec4(radiance, 1.0);
}

// The share of light that is reflected in all directions.
vec3 albedo(Surface surface) {
    return surface.diffuse_weight * surface.diffuse_color;
}
