#include "lib/normal_map.glsl"

// What slopes of a normal map's texels add to the unit normal.
mat2x3 normal_ways(SurfacePoint point, vec3 normal) {
    float size = dot(normal, normal);
    if (!(size > 0.0)) return mat2x3(0.0);
    vec3 tangent = point.tangent.xyz * inversesqrt(size);
    vec3 bitangent = point.tangent.w * cross(normal, tangent) * inversesqrt(size);
    return mat2x3(tangent, bitangent) * transpose(mat2(normal_axes));
}
