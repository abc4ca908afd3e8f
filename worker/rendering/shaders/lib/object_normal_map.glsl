#include "lib/held_normal.glsl"
#include "lib/frames.glsl"
#include "lib/surface_point.glsl"
uniform float normal_strength;

// A normal of the shape itself, on its outer side; strength between 0 and 1 lies between.
vec3 own_normal(SurfacePoint point, vec3 normal, vec3 held) {
    vec3 size = abs(held);
    vec3 world = normal_from_object * (held / max(size.x, max(size.y, size.z)));
    float squared = dot(world, world);
    if (!(squared > 0.0) || normal == vec3(0.0)) return point.normal;
    vec3 outer = mix(normalize(normal), world * inversesqrt(squared), normal_strength);
    squared = dot(outer, outer);
    if (!(squared > 0.0)) return point.normal;
    outer *= inversesqrt(squared);
    return gl_FrontFacing ? outer : -outer;
}
