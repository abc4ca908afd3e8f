#include "lib/fine_relief.glsl"
#include "lib/lobe.glsl"
#include "lib/microfacets.glsl"
#include "lib/streak.glsl"
#include "lib/stretched.glsl"

// KHR_materials_anisotropy: alpha_t = mix(alpha, 1, strength^2), alpha_b = alpha.
Lobe lobe_of(SurfacePoint point, float roughness, float strength, vec2 direction) {
    float alpha = alpha_of(roughness);
    float part = clamp(strength, 0.0, 1.0);
    vec2 size = abs(direction);
    direction /= max(max(size.x, size.y), 1e-30);
    float squared = dot(direction, direction);
    direction = squared > 0.0 ? direction * inversesqrt(squared) : vec2(1.0, 0.0);
    Scratches axes = scratches(point, 0.0);
    Widths widths = stretched(
        vec2(widened(mix(alpha, 1.0, part * part)), widened(alpha)),
        Scratches(
            direction.x * axes.along + direction.y * axes.across,
            direction.x * axes.across - direction.y * axes.along
        )
    );
    return Lobe(min(widths.along, 1.0), widths.axes);
}

const int FACETS = 24;
const vec2 GOLDEN = vec2(-0.73736888, 0.67549029);  // cosine and sine of the golden angle

vec3 reflectance(float seen, float roughness);  // of the surface, from a table of round lobes

// The integral over the facets that the eye sees (Heitz 2018): each reflects the part of its light
// that others do not hide. The table, at the mean of both squared widths, knows no direction and is
// 0.34 off where the eye looks along the surface and across the streak; 24 facets are 0.03 off. Where
// both widths are nearly the same it is the better one.
vec3 reflected_share(Lobe lobe, SurfacePoint point, float seen, float roughness) {
    vec2 alpha = lobe.alpha;
    vec3 view = vec3(dot(lobe.axes.along, point.view), dot(lobe.axes.across, point.view), seen);
    view.z = max(view.z, 1e-3);
    vec3 stretched_view = vec3(alpha * view.xy, view.z);
    float view_side = length(stretched_view);
    vec3 up = stretched_view / view_side;
    float level = dot(up.xy, up.xy);
    vec3 right = level > 0.0 ? vec3(-up.y, up.x, 0.0) * inversesqrt(level) : vec3(1.0, 0.0, 0.0);
    vec3 forward = cross(up, right);
    vec2 way = vec2(1.0, 0.0);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < FACETS; i++) {
        vec2 place = sqrt((float(i) + 0.5) / float(FACETS)) * way;
        way = vec2(way.x * GOLDEN.x - way.y * GOLDEN.y, way.x * GOLDEN.y + way.y * GOLDEN.x);
        float edge = sqrt(max(1.0 - place.x * place.x, 0.0));
        place.y = mix(edge, place.y, 0.5 + 0.5 * up.z);
        float rest = sqrt(max(1.0 - dot(place, place), 0.0));
        vec3 facet = place.x * right + place.y * forward + rest * up;
        facet = normalize(vec3(alpha * facet.xy, max(facet.z, 1e-6)));
        float met = dot(view, facet);
        vec3 light = 2.0 * met * facet - view;
        float facing = max(light.z, 0.0);
        float light_side = length(vec3(alpha * light.xy, light.z));
        float open = facing * (view.z + view_side)
            / max(facing * view_side + view.z * light_side, 1e-20);
        sum += open * vec2(1.0, schlick(met));
    }
    sum /= float(FACETS);
    vec3 counted = vec3(sum.x - sum.y, sum.y, sum.x);
    vec3 table = reflectance(seen, sqrt(sqrt(0.5 * dot(alpha, alpha))));
    float ratio = min(alpha.x, alpha.y) / max(alpha.x, alpha.y);
    return mix(counted, table, clamp(5.0 * ratio - 4.0, 0.0, 1.0));
}

// GGX with two widths and Smith's shadowing (Burley 2012; Heitz 2014), as the extension writes it.
float highlight_of(Lobe lobe, SurfacePoint point, vec3 half_way, vec3 light, float facing, float seen) {
    vec2 alpha = lobe.alpha;
    float both = alpha.x * alpha.y;
    vec3 lean = vec3(
        alpha.y * dot(lobe.axes.along, half_way),
        alpha.x * dot(lobe.axes.across, half_way),
        both * dot(point.normal, half_way)
    );
    float spread = both / max(dot(lean, lean), 0.25 * both * both);
    vec2 light_lean = alpha * vec2(dot(lobe.axes.along, light), dot(lobe.axes.across, light));
    vec2 view_lean = alpha * vec2(dot(lobe.axes.along, point.view), dot(lobe.axes.across, point.view));
    float light_side = seen * length(vec3(light_lean, facing));
    float view_side = facing * length(vec3(view_lean, seen));
    float shadowed = 0.5 * facing / max(light_side + view_side, 1e-30);
    return both * spread * spread / 3.14159265 * shadowed;
}

vec3 sky_in_lobe(Lobe lobe, SurfacePoint point, vec3 mirrored, float reach, float roughness) {
    return sky_in_streak(point, lobe.axes, lobe.alpha, false, reach);
}
