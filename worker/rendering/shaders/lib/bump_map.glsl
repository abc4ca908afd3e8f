#include "lib/leaned.glsl"
#include "lib/surface_point.glsl"
uniform vec4 bump_axes;

// What a bump map adds to the unit outer normal: r t1 + g t2, of t1 where u grows, across the normal,
// and t2 = sign cross(n, t1) where v grows (Hughes et al. 2013, section 20.2).
vec3 bump_lean(SurfacePoint point, vec3 normal, vec2 texel) {
    vec2 tilt = vec2(dot(bump_axes.xy, texel), dot(bump_axes.zw, texel));
    vec3 along = point.tangent.xyz - dot(point.tangent.xyz, normal) * normal;
    float size = dot(along, along);
    if (!(size > 0.0)) return vec3(0.0);
    vec3 t1 = along * inversesqrt(size);
    return tilt.x * t1 + tilt.y * point.tangent.w * cross(normal, t1);
}
