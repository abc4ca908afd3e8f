#include "lib/frames.glsl"

const float CYLINDRICAL_TURN = 6.28318531;

// The axes so that the third is the one round which the angle is counted, from the first.
vec3 cylindrical_axes(vec3 vector, const int axis) {
    if (axis == 0) return vector.yzx;
    return axis == 1 ? vec3(vector.x, -vector.z, vector.y) : vector;
}

// The change of the angle comes from the position's, which has no seam, and is a turn at most.
vec2 cylindrical_change(vec3 place, vec3 change, float height, bool inside) {
    float squared = max(dot(place.xy, place.xy), 1e-30);
    float turned = (place.x * change.y - place.y * change.x) / squared;
    float raised = inside ? change.z / height : 0.0;
    return vec2(clamp(turned / CYLINDRICAL_TURN, -1.0, 1.0), raised);
}

Footprint coordinates_cylindrical(
    SurfacePoint point, const int axis, float base, float height, const int frame
) {
    Reach position = position_in(point, frame);
    vec3 place = cylindrical_axes(position.place, axis);
    float u = atan(place.y, place.x) / CYLINDRICAL_TURN;
    float v = (place.z - base) / height;
    bool inside = v > 0.0 && v < 1.0;
    return Footprint(
        vec2(u - floor(u), clamp(v, 0.0, 1.0)),
        cylindrical_change(place, cylindrical_axes(position.across_x, axis), height, inside),
        cylindrical_change(place, cylindrical_axes(position.across_y, axis), height, inside)
    );
}
