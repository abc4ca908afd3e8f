#include "lib/reach.glsl"
#include "lib/surface_point.glsl"

// The frames that coordinates may be in: 0 the world, 1 the mesh's own, 2 the eye's, with x to the
// right, y up and z backwards.
uniform vec3 eye_position;       // in the world
uniform mat3 camera_from_world;  // a turn
uniform mat4 eye_from_object;    // axes of the world, origin at the eye
uniform mat3 normal_from_object;

Reach turned(mat3 to_from, Reach reach) {
    return Reach(to_from * reach.place, to_from * reach.across_x, to_from * reach.across_y);
}

// Where the point is.
Reach position_in(SurfacePoint point, const int frame) {
    if (frame == 1) return reach_of(point.object_position);
    Reach position = reach_of(point.position);
    if (frame == 2) return turned(camera_from_world, position);
    return Reach(position.place + eye_position, position.across_x, position.across_y);
}

// A direction of the world. The inverse of what takes normals to the world, transposed, is the
// matrix that took positions there.
Reach direction_in(vec3 direction, const int frame) {
    Reach reach = difference_of(direction);
    if (frame == 1) return turned(transpose(normal_from_object), reach);
    if (frame == 2) return turned(camera_from_world, reach);
    return reach;
}

// A normal of the world, of any length.
Reach normal_in(vec3 normal, const int frame) {
    if (frame == 1) return turned(transpose(mat3(eye_from_object)), difference_of(normal));
    return direction_in(normal, frame);
}
