#include "layouts/latlong.glsl"
#include "lib/environment.glsl"

uniform sampler2D sky_picture;
uniform int sky_centre;

// A level for the picture's rows: near the poles texels are narrow, and more of them are read.
vec3 sky_sharp(vec3 direction, float reach) {
    float texels = reach * float(textureSize(sky_picture, 0).y) / LATLONG_PI;
    return textureLod(sky_picture, layout_latlong(direction, sky_centre), level_for(texels)).rgb;
}
