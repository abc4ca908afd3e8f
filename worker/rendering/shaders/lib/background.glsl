#include "lib/footprint.glsl"
#include "lib/picture.glsl"
uniform vec2 corner;        // of the tile in the whole picture, in samples from the lower left
uniform vec2 picture_size;  // width and height of the whole picture in pixels
uniform float samples_per_side;

// A hair less than a pixel: rounding must not make it more than a texel of the same size.
const float REACH = 0.99999;

// The pixel's middle, u to the right and v up from 0 to 1: all samples of a pixel read the same, so
// that a picture of the same size is seen as it is.
Footprint coordinates_picture() {
    vec2 pixel = floor((gl_FragCoord.xy + corner) / samples_per_side) + 0.5;
    vec2 reach = REACH / picture_size;
    return Footprint(pixel / picture_size, vec2(reach.x, 0.0), vec2(0.0, reach.y));
}
