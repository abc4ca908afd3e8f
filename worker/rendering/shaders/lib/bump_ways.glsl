#include "lib/bump_map.glsl"

// What a bump map's tilts add to the unit outer normal.
mat2x3 bump_ways(SurfacePoint point, vec3 normal) {
    return mat2x3(
        bump_lean(point, normal, vec2(1.0, 0.0)), bump_lean(point, normal, vec2(0.0, 1.0))
    );
}
