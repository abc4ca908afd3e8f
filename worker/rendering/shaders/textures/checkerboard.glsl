#include "lib/extent.glsl"
#include "lib/lattice.glsl"

// The mean of the square wave, +1 in even squares and -1 in odd ones, over a width in squares.
float mean_sign(float place, int cells, float reach) {
    if (cells == 0) return 1.0;
    LatticePlace at = lattice_place(place, cells, 0.0);
    float width = reach * float(cells);
    if (width <= 1.0) {
        // At most one edge lies within
        float inside = 2.0 * min(at.offset, 1.0 - at.offset);
        float mean = width > inside ? inside / width : 1.0;
        return (at.cell & 1) == 0 ? mean : -mean;
    }
    vec2 ends = at.offset + float(at.cell & 1) + vec2(-0.5, 0.5) * width;
    vec2 triangle = 1.0 - abs(1.0 - mod(ends, 2.0));
    return (triangle.y - triangle.x) / width;
}

// Squares or cubes of two colours (Hughes et al. 2013, 20.7), averaged over the box of the pixel.
// cells: per tile, 0 along an axis that has none.
vec4 texture_checkerboard(
    vec3 place, vec3 across_x, vec3 across_y, vec3 cells, vec3 first, vec3 second
) {
    vec3 reach = pixel_box(across_x, across_y);
    float sign = 1.0;
    for (int axis = 0; axis < 3; axis++) {
        sign *= mean_sign(place[axis], int(cells[axis]), reach[axis]);
    }
    return vec4(mix(second, first, 0.5 + 0.5 * sign), 1.0);
}
