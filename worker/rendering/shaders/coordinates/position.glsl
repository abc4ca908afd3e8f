#include "lib/frames.glsl"

// t = A x + b.
Reach coordinates_position(SurfacePoint point, const int frame, mat3 matrix, vec3 offset) {
    Reach place = turned(matrix, position_in(point, frame));
    place.place += offset;
    return place;
}
