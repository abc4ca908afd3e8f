#include "lib/level_of_detail.glsl"
#include "lib/sky.glsl"

// An environment: as it is, as rough mirrors see it, and as chalk does. worker/rendering/sky.py
// makes them.
uniform samplerCube sky_rough;  // the lobes of GGX, each level rougher by a step
uniform samplerCube sky_matt;   // irradiance over pi
uniform bool sky_matt_smooth;   // whether nine numbers hold it
uniform vec3 sky_harmonics[9];  // of 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy
uniform mat3 sky_from_world;
uniform float sky_intensity;

const float SKY_STEPS = 5.0;      // of roughness from 0, which is the environment itself, to 1
const float SKY_LOBE = 2.5;       // width of a lobe by alpha, in radians
const float SKY_QUARTER = 1.570796;

// The environment itself; reach is an angle in radians.
vec3 sky_sharp(vec3 direction, float reach);

vec3 sky_on_matt(vec3 normal) {
    vec3 n = sky_from_world * normal;
    vec3 smooth_light = sky_harmonics[0]
        + sky_harmonics[1] * n.y + sky_harmonics[2] * n.z + sky_harmonics[3] * n.x
        + sky_harmonics[4] * (n.x * n.y) + sky_harmonics[5] * (n.y * n.z)
        + sky_harmonics[6] * (3.0 * n.z * n.z - 1.0) + sky_harmonics[7] * (n.x * n.z)
        + sky_harmonics[8] * (n.x * n.x - n.y * n.y);
    vec3 light = sky_matt_smooth ? max(smooth_light, 0.0) : textureLod(sky_matt, n, 0.0).rgb;
    return sky_intensity * light;
}

// Below the first step the sharp picture, as blurred as its own levels allow, fades to that step. A
// pixel that sees more directions than the lobe has widens it.
vec3 sky_in_mirror(vec3 direction, float reach, float roughness) {
    vec3 towards = sky_from_world * direction;
    float rough = clamp(roughness, 0.0, 1.0);
    float alpha = rough * rough;
    float wider = sqrt(min(length(vec2(alpha, reach / SKY_LOBE)), 1.0));
    vec3 blurred = textureLod(sky_rough, towards, max(wider * SKY_STEPS - 1.0, 0.0)).rgb;
    vec3 sharp = sky_sharp(towards, max(reach, SKY_LOBE * alpha));
    return sky_intensity * mix(sharp, blurred, min(rough * SKY_STEPS, 1.0));
}
