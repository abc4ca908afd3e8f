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

// The mean of both squared widths: within 0.05 (RMS) of the integral over what lobes there are.
float even_roughness(Lobe lobe, float roughness) {
    return sqrt(sqrt(0.5 * dot(lobe.alpha, lobe.alpha)));
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
