// Sides of the box that holds a pixel, in tiles.
vec3 pixel_box(vec3 across_x, vec3 across_y) {
    return abs(across_x) + abs(across_y);
}

// What is left of a layer of noise with so many cells per tile: all at four pixels per cell, nothing
// at two. Beyond 2^19 cells float32 has no places left.
float visibility(float cells, vec3 across_x, vec3 across_y) {
    float reach = max(max(length(across_x), length(across_y)), 9.5367431640625e-7);
    return smoothstep(2.0, 4.0, 1.0 / (reach * cells));
}
