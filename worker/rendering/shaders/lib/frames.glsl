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

// Unit length, or none where there is none.
vec3 unit(vec3 vector) {
    return vector / max(length(vector), 1e-30);
}

// A direction of the world. The inverse of what takes normals to the world, transposed, is the
// matrix that took positions there.
Reach direction_in(vec3 direction, const int frame) {
    if (frame == 1) return difference_of(unit(transpose(normal_from_object) * direction));
    if (frame == 2) return difference_of(camera_from_world * direction);
    return difference_of(direction);
}

// A normal of the world.
Reach normal_in(vec3 normal, const int frame) {
    if (frame == 1) return difference_of(unit(transpose(mat3(eye_from_object)) * normal));
    return direction_in(normal, frame);
}
