#include "layouts/hemispheres.glsl"
#include "lib/environment.glsl"

uniform sampler2D sky_picture;

// Nothing is read across the middle of the picture, where the rims of both discs meet.
vec3 sky_sharp(vec3 direction, float reach) {
    vec2 size = vec2(textureSize(sky_picture, 0));
    float level = level_for(reach * 0.5 * size.y);
    vec2 place = layout_hemispheres(Reach(direction, vec3(0.0), vec3(0.0)), 0).place;
    float margin = min(0.5 * exact_exp2(ceil(level)) / size.x, 0.25);
    float first = direction.y < 0.0 ? 0.5 : 0.0;
    place.x = clamp(place.x, first + margin, first + 0.5 - margin);
    return textureLod(sky_picture, place, level).rgb;
}
