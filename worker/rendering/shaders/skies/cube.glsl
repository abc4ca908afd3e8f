#include "lib/environment.glsl"

uniform samplerCube sky_picture;

vec3 sky_sharp(vec3 direction, float reach) {
    float texels = reach * float(textureSize(sky_picture, 0).x) / SKY_QUARTER;
    return textureLod(sky_picture, direction, level_for(texels)).rgb;
}
