#include "lib/fine_relief.glsl"
#include "lib/lights.glsl"
#include "lib/microfacets.glsl"
#include "lib/sky.glsl"
#include "lib/surface_point.glsl"

struct Surface {
    vec3 color;
    float ior;
    float roughness;
};

// What part of unpolarised light a clear surface reflects (Fresnel 1823, as Cook and Torrance 1982
// write it); all of it beyond the critical angle.
float reflected_part(float cosine, float ior) {
    float squared = ior * ior - 1.0 + cosine * cosine;
    float g = sqrt(max(squared, 0.0));
    float across = (g - cosine) / max(g + cosine, 1e-20);
    float along = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return squared < 0.0 ? 1.0 : 0.5 * across * across * (1.0 + along * along);
}

// A point without a normal shows its colour.
vec4 shade(SurfacePoint point, Surface surface) {
    float ior = gl_FrontFacing ? surface.ior : 1.0 / surface.ior;
    // At the rim a smooth normal may turn away from the eye; it is turned back just so far.
    vec3 normal = point.normal - min(dot(point.normal, point.view), 0.0) * point.view;
    normal *= inversesqrt(max(dot(normal, normal), 1e-20));
    vec3 mirrored = reflect(-point.view, normal);
    vec3 bent = refract(-point.view, normal, 1.0 / ior);
    float mirrored_reach = reach_to(mirrored), bent_reach = reach_to(bent);
    vec3 tint = surface.color * point.color.rgb;
    if (point.normal == vec3(0.0)) return vec4(tint, 1.0);
    float seen = clamp(dot(normal, point.view), 0.0, 1.0);
    float part = reflected_part(seen, ior);
    vec3 even = light_all_around();
    float roughness = roughened(surface.roughness);
    vec3 in_mirror = even + sky_in_mirror(mirrored, mirrored_reach, roughness);
    vec3 behind = even + sky_in_mirror(bent, bent_reach, roughness);
    vec3 radiance = part * in_mirror + (1.0 - part) * tint * behind;
    float alpha = alpha_of(roughness);
    for (int i = 0; i < light_total(); i++) {
        Light light = light_at(i, point);
        vec3 half_way = light.direction + point.view;
        half_way *= inversesqrt(max(dot(half_way, half_way), 1e-20));
        float facing = max(dot(normal, light.direction), 0.0);
        float peak = highlight(normal, half_way, facing, seen, alpha);
        float towards = clamp(dot(point.view, half_way), 0.0, 1.0);
        radiance += reflected_part(towards, ior) * peak * light.irradiance;
    }
    return vec4(radiance, 1.0);
}

// The colour of what is seen through it.
vec3 albedo(Surface surface) {
    return surface.color;
}
