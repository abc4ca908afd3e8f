#include "lib/surface_point.glsl"

// Two directions in the surface: along the scratches and across them, a right angle further
// counter-clockwise. Of a mesh without texture coordinates they follow the world's axes.
struct Scratches {
    vec3 along;
    vec3 across;
};

// e1 = P_u made perpendicular to n, e2 = w cross(n, e1), both turned by an angle in radians.
Scratches scratches(SurfacePoint point, float angle) {
    vec3 normal = point.normal;
    vec3 tangent = point.tangent.xyz - normal * dot(normal, point.tangent.xyz);
    float side = gl_FrontFacing ? point.tangent.w : -point.tangent.w;
    if (dot(tangent, tangent) < 1e-12) {
        vec3 axis = abs(normal.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        tangent = axis - normal * dot(normal, axis);
        side = 1.0;
    }
    tangent = normalize(tangent);
    vec3 bitangent = side * cross(normal, tangent);
    float cosine = cos(angle), sine = sin(angle);
    return Scratches(cosine * tangent + sine * bitangent, cosine * bitangent - sine * tangent);
}
