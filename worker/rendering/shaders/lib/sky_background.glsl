#include "lib/picture.glsl"
#include "lib/sky.glsl"

uniform vec3 ray_middle;  // of the tile, in the world
uniform vec3 ray_across;  // from there to the tile's right edge
uniform vec3 ray_up;      // and to its upper edge
uniform vec2 tile_size;   // in samples

// Where the eye looks through this sample.
vec3 ray() {
    vec2 place = 2.0 * gl_FragCoord.xy / tile_size - 1.0;
    return normalize(ray_middle + place.x * ray_across + place.y * ray_up);
}
