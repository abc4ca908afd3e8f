#include "lib/footprint.glsl"

// Where on a picture to look, and how far the pixel reaches there.
struct Lookup {
    vec2 place;     // texture coordinates, brought into the first period of the wrap
    vec2 size;      // of the picture's level 0 in texels
    vec2 across_x;  // texels from this pixel's middle to the next one's on the right
    vec2 across_y;  // and to the one above
    vec2 period;    // of the wrap in pictures: 1 repeated, 2 mirrored, 0 neither
};

// The footprint is that of the coordinates before they are wrapped, so that no seam harms it.
// period holds the wrap's periods along u and v and their inverses, 0 where it does not repeat.
Lookup look_up(Footprint coordinates, mat3 transform, vec4 period, vec2 size) {
    mat2 linear = mat2(transform);
    vec2 place = (transform * vec3(coordinates.place, 1.0)).xy;
    return Lookup(
        place - period.xy * floor(place * period.zw),
        size,
        linear * coordinates.across_x * size,
        linear * coordinates.across_y * size,
        period.xy
    );
}
