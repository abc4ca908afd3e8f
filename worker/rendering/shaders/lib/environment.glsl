#include "lib/level_of_detail.glsl"
#include "lib/sky.glsl"

// An environment: as it is, as rough mirrors see it, and as chalk does. worker/rendering/sky.py
// makes them.
uniform samplerCube sky_rough;  // the lobes of GGX, each level rougher by a step
uniform samplerCube sky_matt;   // irradiance over pi
uniform mat3 sky_from_world;
uniform float sky_intensity;

const float SKY_STEPS = 5.0;      // of roughness from 0, which is the environment itself, to 1
const float SKY_LOBE = 2.5;       // width of a lobe by alpha, in radians
const float SKY_QUARTER = 1.570796;

// The environment itself; reach is an angle in radians.
vec3 sky_sharp(vec3 direction, float reach);

vec3 sky_on_matt(vec3 normal) {
    return sky_intensity * textureLod(sky_matt, sky_from_world * normal, 0.0).rgb;
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
