#include "lib/object_frame.glsl"
#include "lib/surface_point.glsl"

// A surface in its object's own frame, where depths are measured, and how it goes on to the next
// pixels. vertex_normal and inverse_w() are those of this fragment.
struct Patch {
    vec3 normal;    // unit, on the outer side, as interpolated
    vec3 across_x;  // across the normal: from this pixel's middle to the next one's on the right
    vec3 across_y;  // and to the one above
    float area;     // of those two, signed
};

// What is linear on the surface, changed from pixel to pixel: as coordinates_uv does it.
vec3 change_x(vec3 value) {
    float w = inverse_w();
    return (dFdx(value * w) - value * dFdx(w)) / w;
}

vec3 change_y(vec3 value) {
    float w = inverse_w();
    return (dFdy(value * w) - value * dFdy(w)) / w;
}

vec3 laid(vec3 vector, vec3 normal) {
    return vector - dot(vector, normal) * normal;
}

// The normal's transform is the inverse transpose of the place's, up to a positive factor.
vec3 object_normal(vec3 normal) {
    return normalize(transpose(mat3(eye_from_object)) * normal);
}

Patch patch_at(SurfacePoint point, vec3 normal) {
    mat3 object_from_world = inverse(mat3(eye_from_object));
    vec3 outer = object_normal(normal);
    vec3 x = laid(object_from_world * change_x(point.position), outer);
    vec3 y = laid(object_from_world * change_y(point.position), outer);
    return Patch(outer, x, y, dot(cross(x, y), outer));
}
