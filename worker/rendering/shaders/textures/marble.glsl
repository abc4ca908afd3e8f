#include "lib/waves.glsl"

// Waves bent by turbulence (Perlin 1985), averaged over the pixel as if nothing bent them.
// veins: swings per tile along u, v, w.
vec4 texture_marble(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    vec4 turbulence_value,
    vec3 veins,
    float strength,
    float rest,
    float scale,
    float bias
) {
    float turn = turns(place.x, veins.x) + turns(place.y, veins.y) + turns(place.z, veins.z);
    float angle = 6.28318531 * (turn - floor(turn)) + strength * (turbulence_value.r - rest);
    float fade = sinc(dot(veins, across_x)) * sinc(dot(veins, across_y));
    return vec4(vec3(scale * fade * sin(angle) + bias), 1.0);
}
