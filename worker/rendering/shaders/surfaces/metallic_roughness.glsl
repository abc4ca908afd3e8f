#include "lib/lights.glsl"
#include "lib/lobe.glsl"
#include "lib/microfacets.glsl"
#include "lib/sky.glsl"
#include "lib/surface_point.glsl"

struct Surface {
    vec3 base_color;
    float metallic;
    float roughness;
    float occlusion;
    vec3 emission;
    float ior;
    float specular;
    vec3 specular_color;
    float clearcoat;
    float clearcoat_roughness;
    float anisotropy_strength;
    float anisotropy_rotation;
    float anisotropy_x;
    float anisotropy_y;
    int energy_compensation;
};

const float PI = 3.14159265;
const float COAT_F0 = 0.04;  // of varnish with an index of refraction of 1.5

uniform sampler2D table_dfg;  // A, B and A + B over n.v and roughness, outermost texels at 0 and 1

vec3 reflectance(float seen, float roughness) {
    vec2 place = clamp(vec2(seen, roughness), 0.0, 1.0);
    vec2 size = vec2(textureSize(table_dfg, 0));
    return textureLod(table_dfg, (place * (size - 1.0) + 0.5) / size, 0.0).rgb;
}

// Fresnel's reflection: f0 head-on, f90 at grazing angles.
struct Fresnel {
    vec3 f0;
    vec3 f90;
};

vec3 reflected_at(Fresnel fresnel, float grazing) {
    return fresnel.f0 + (fresnel.f90 - fresnel.f0) * grazing;
}

// Of light from everywhere, per table A, B, A + B.
vec3 reflected_of_all(Fresnel fresnel, vec3 table) {
    return fresnel.f0 * table.r + fresnel.f90 * table.g;
}

// What has bounced between microfacets comes out too (Turquin 2019): brighter by
// 1 + F0 (1 - A - B) / (A + B), where lost is that last fraction.
Fresnel regained(Fresnel fresnel, float lost) {
    vec3 gain = 1.0 + lost * fresnel.f0;
    return Fresnel(fresnel.f0 * gain, fresnel.f90 * gain);
}

float largest(vec3 color) {
    return max(color.r, max(color.g, color.b));
}

vec2 turned(vec2 vector, float angle) {
    float cosine = cos(angle), sine = sin(angle);
    return vec2(cosine * vector.x - sine * vector.y, sine * vector.x + cosine * vector.y);
}

// glTF 2.0, appendix B, with KHR_materials_ior, _specular, _clearcoat and _anisotropy:
// F = F0 + (F90 - F0) (1 - v.h)^5, f = (1 - metallic) (1 - F) c / pi + F D V, the varnish on top.
// Light from all around is split into two (Karis 2013): what the mirrored lobe gathers of it, times
// F0 A + F90 B of a sky that is everywhere alike; what a dielectric does not reflect reaches the
// matt part.
// A point without a normal shows emission + c.
vec4 shade(SurfacePoint point, Surface surface) {
    vec3 mirrored = reflect(-point.view, point.normal);
    float reach = reach_to(mirrored);
    vec3 base = surface.base_color * point.color.rgb;
    if (point.normal == vec3(0.0)) return vec4(surface.emission + base, 1.0);
    float metallic = clamp(surface.metallic, 0.0, 1.0);
    float specular = clamp(surface.specular, 0.0, 1.0);
    float ratio = (surface.ior - 1.0) / (surface.ior + 1.0);
    vec3 dielectric_f0 = specular * clamp(ratio * ratio * surface.specular_color, 0.0, 1.0);
    Fresnel dielectric = Fresnel(dielectric_f0, vec3(specular));
    vec3 matt = (1.0 - metallic) * base;
    vec2 direction =
        turned(vec2(surface.anisotropy_x, surface.anisotropy_y), surface.anisotropy_rotation);
    Lobe lobe = lobe_of(point, surface.roughness, surface.anisotropy_strength, direction);
    float seen = clamp(dot(point.normal, point.view), 0.0, 1.0);
    vec3 table = reflected_share(lobe, point, seen, surface.roughness);
    float lost = surface.energy_compensation == 1 ? (1.0 - table.b) / table.b : 0.0;
    Fresnel brighter = regained(dielectric, lost);
    Fresnel metal = regained(Fresnel(base, vec3(1.0)), lost);
    Fresnel both = Fresnel(
        mix(brighter.f0, metal.f0, metallic), mix(brighter.f90, metal.f90, metallic)
    );

    float coat_alpha = alpha_of(surface.clearcoat_roughness);
    float coat_seen = clamp(dot(point.smooth_normal, point.view), 0.0, 1.0);
    float coat = clamp(surface.clearcoat, 0.0, 1.0)
        * (COAT_F0 + (1.0 - COAT_F0) * schlick(coat_seen));

    vec3 even = light_all_around();
    vec3 on_matt = even + sky_on_matt(point.normal);
    vec3 in_mirror = even + sky_in_lobe(lobe, point, mirrored, reach, surface.roughness);
    vec3 coat_mirrored = reflect(-point.view, point.smooth_normal);
    vec3 in_coat = even + sky_in_mirror(coat_mirrored, reach, surface.clearcoat_roughness);
    vec3 below_all = matt * (1.0 - largest(reflected_of_all(brighter, table)));
    vec3 radiance = on_matt * below_all + in_mirror * reflected_of_all(both, table);
    radiance = surface.emission + surface.occlusion * radiance;
    float coat_reflects = reflectance(coat_seen, surface.clearcoat_roughness).b;
    vec3 on_coat = surface.occlusion * coat_reflects * in_coat;
    for (int i = 0; i < light_total(); i++) {
        Light light = light_at(i, point);
        vec3 half_way = light.direction + point.view;
        half_way *= inversesqrt(max(dot(half_way, half_way), 1e-20));
        float grazing = schlick(dot(point.view, half_way));
        float facing = max(dot(point.normal, light.direction), 0.0);
        float coat_facing = max(dot(point.smooth_normal, light.direction), 0.0);
        vec3 below = matt * ((1.0 - largest(reflected_at(dielectric, grazing))) * facing / PI);
        float peak = highlight_of(lobe, point, half_way, light.direction, facing, seen);
        float coat_peak = highlight(point.smooth_normal, half_way, coat_facing, coat_seen, coat_alpha);
        radiance += (below + reflected_at(both, grazing) * peak) * light.irradiance;
        on_coat += coat_peak * light.irradiance;
    }
    return vec4(mix(radiance, on_coat, coat), 1.0);
}

// The colour of the matt part, or of the metal.
vec3 albedo(Surface surface) {
    return surface.base_color;
}
