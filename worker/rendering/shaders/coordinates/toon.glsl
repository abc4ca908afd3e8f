#include "lib/lamps.glsl"
#include "lib/power.glsl"
#include "lib/reach.glsl"
#include "lib/surface_point.glsl"

// Tone and detail of Barla, Thollot and Markosian 2006. The lamp is the one that is faced most.
Footprint coordinates_toon(
    SurfacePoint point, const int detail, float power, float near, float far
) {
    float tone = 0.0;
    vec3 lamp = vec3(0.0);
    for (int i = 0; i < light_count; i++) {
        vec3 direction = lamp_at(i, point).direction;
        float facing = dot(point.normal, direction);
        lamp = facing > tone ? direction : lamp;
        tone = max(tone, facing);
    }
    float v;
    if (detail == 2) {
        float distance = clamp(length(point.position), near, max(far, near));
        v = 1.0 - exact_log2(distance / near) / max(exact_log2(max(far / near, 1.0)), 1e-6);
    } else {
        vec3 mirrored = 2.0 * tone * point.normal - lamp;
        float seen = dot(detail == 0 ? point.normal : mirrored, point.view);
        v = exact_power(clamp(seen, 0.0, 1.0), power);
    }
    return flat_reach(difference_of(vec3(clamp(tone, 0.0, 1.0), clamp(v, 0.0, 1.0), 0.0)));
}
