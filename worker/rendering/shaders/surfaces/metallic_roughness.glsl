#include "lib/lights.glsl"
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
    int energy_compensation;
};

vec4 shade(SurfacePoint point, Surface surface) {
    vec3 radiance = surface.emission + surface.base_color * ambient_radiance * surface.occlusion;
    for (int i = 0; i < light_count; i++) {
        Light light = light_at(i, point.position);
        radiance += surface.base_color * light.irradiance * max(dot(point.normal, light.direction), 0.0) / 3.14159265;
    }
    return vec4(radiance, 1.0);
}

vec3 albedo(Surface surface) {
    return surface.base_color;
}
