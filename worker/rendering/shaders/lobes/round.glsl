#include "lib/fine_relief.glsl"
#include "lib/lobe.glsl"
#include "lib/microfacets.glsl"
#include "lib/sky.glsl"

Lobe lobe_of(SurfacePoint point, float roughness, float strength, vec2 direction) {
    return Lobe(vec2(alpha_of(roughened(roughness))), Scratches(vec3(0.0), vec3(0.0)));
}

vec3 reflectance(float seen, float roughness);  // of the surface, from a table

vec3 reflected_share(Lobe lobe, SurfacePoint point, float seen, float roughness) {
    return reflectance(seen, roughened(roughness));
}

float highlight_of(Lobe lobe, SurfacePoint point, vec3 half_way, vec3 light, float facing, float seen) {
    return highlight(point.normal, half_way, facing, seen, lobe.alpha.x);
}

vec3 sky_in_lobe(Lobe lobe, SurfacePoint point, vec3 mirrored, float reach, float roughness) {
    return sky_in_mirror(mirrored, reach, roughened(roughness));
}
