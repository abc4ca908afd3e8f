#include "lib/sky.glsl"

vec3 sky_on_matt(vec3 normal) {
    return vec3(0.0);
}

vec3 sky_in_mirror(vec3 direction, float reach, float roughness) {
    return vec3(0.0);
}
