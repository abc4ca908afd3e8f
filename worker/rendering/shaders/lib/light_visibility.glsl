#include "lib/lights.glsl"

// How much of the lamps' light reaches the point, which it faces: 0 to 1, each lamp weighted by its
// irradiance there. 0 where none shines.
float light_visibility(SurfacePoint point) {
    vec2 sum = vec2(0.0);
    for (int i = 0; i < light_count; i++) {
        Light light = lamp_at(i, point);
        float strength = dot(min(light.irradiance, 1e30), vec3(1.0));
        bool faced = point.normal == vec3(0.0) || dot(point.normal, light.direction) > 0.0;
        sum += strength * vec2(faced ? seen_by_light(i, point) : 0.0, 1.0);
    }
    return sum.y > 0.0 ? sum.x / sum.y : 0.0;
}
