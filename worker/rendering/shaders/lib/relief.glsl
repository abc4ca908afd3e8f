#include "lib/frames.glsl"
#include "lib/surface_point.glsl"

// A surface in its object's own frame, where depths are measured, and how it goes on to the next
// pixels.
struct Patch {
    vec3 normal;    // unit, on the outer side, as interpolated
    vec3 across_x;  // across the normal: from this pixel's middle to the next one's on the right
    vec3 across_y;  // and to the one above
    float area;     // of those two, signed
};

vec3 laid(vec3 vector, vec3 normal) {
    return vector - dot(vector, normal) * normal;
}

// Of a normal in the world: its transform is the inverse transpose of that of places, up to a
// positive factor.
vec3 own_unit_normal(vec3 normal) {
    return normalize(transpose(mat3(eye_from_object)) * normal);
}

Patch patch_at(SurfacePoint point, vec3 normal) {
    mat3 object_from_world = inverse(mat3(eye_from_object));
    Reach place = reach_of(point.position);
    vec3 outer = own_unit_normal(normal);
    vec3 x = laid(object_from_world * place.across_x, outer);
    vec3 y = laid(object_from_world * place.across_y, outer);
    return Patch(outer, x, y, dot(cross(x, y), outer));
}
