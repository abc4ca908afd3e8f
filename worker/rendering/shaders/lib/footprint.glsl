// Coordinates on a picture, and their change from this pixel's middle to the next one's.
struct Footprint {
    vec2 place;
    vec2 across_x;  // to the right
    vec2 across_y;  // upwards
};
