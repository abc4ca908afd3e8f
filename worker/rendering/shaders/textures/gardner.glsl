#include "lib/waves.glsl"

// A sum of cosines (Gardner 1985), each averaged over the parallelogram of the pixel.
// waves: swings per tile along u, v, w, and the phase in turns.
vec4 texture_gardner(
    vec3 place, vec3 across_x, vec3 across_y, vec4 waves[256], int count, float scale, float bias
) {
    float sum = 0.0;
    for (int i = 0; i < count; i++) {
        vec3 swings = waves[i].xyz;
        float angle = turns(place.x, swings.x) + turns(place.y, swings.y)
            + turns(place.z, swings.z) + waves[i].w;
        float fade = sinc(dot(swings, across_x)) * sinc(dot(swings, across_y));
        sum += fade * cos(6.28318531 * (angle - floor(angle)));
    }
    return vec4(vec3(scale * sum + bias), 1.0);
}
