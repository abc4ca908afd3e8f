#include "lib/held_normal.glsl"
#include "lib/surface_point.glsl"

// n = x T + y B + z N with B = sign cross(N, T), of N and T as they are interpolated, not made unit
// again: what MikkTSpace's bakers take away, this puts back (Mikkelsen 2008).
//   normal: as interpolated, on the outer side
//   tilt: the picture's x, y, z in the axes of u and v
// Without a tangent, as on lines and points, there is nothing to tilt along. Seen from inside, a bump
// is a dent.
vec3 tilted_normal(SurfacePoint point, vec3 normal, vec3 tilt) {
    vec3 tangent = point.tangent.xyz;
    vec3 bitangent = point.tangent.w * cross(normal, tangent);
    vec3 size = abs(tilt);
    tilt /= max(size.x, max(size.y, size.z));  // lest the square of a large one is infinite
    vec3 tilted = tilt.x * tangent + tilt.y * bitangent + tilt.z * normal;
    float squared = dot(tilted, tilted);
    if (tangent == vec3(0.0) || !(squared > 0.0)) return point.normal;
    vec3 outer = tilted * inversesqrt(squared);
    return gl_FrontFacing ? outer : -outer;
}
