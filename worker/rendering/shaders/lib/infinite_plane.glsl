#include "lib/point_seen.glsl"
#include "lib/reach.glsl"
// Of (x, y, 1) in samples from an origin near the horizon; worker/rendering/infinite_planes.py says why these are linear.
uniform vec2 pixel_origin;
uniform mat3 plane_from_pixel;     // to u / w, v / w, 1 / w
uniform mat3 position_from_pixel;  // to the position over w
uniform mat3 object_from_pixel;    // and in the object's frame
uniform vec3 depth_from_pixel;     // to the depth: 1 at the near plane, 0 at the far one

const float HORIZON = 1e-15;          // 1 / w of what is as far away as numbers reach
const float BEYOND_FAR_PLANE = 1e-20;  // depths below any that what ends there has

vec3 pixel() {
    return vec3(gl_FragCoord.xy - pixel_origin, 1.0);
}

// Where the ray of this pixel meets the plane; behind the eye if inverse_w is below 0.
SurfacePoint surface_point() {
    vec3 plane = plane_from_pixel * pixel();
    inverse_w = abs(plane.z) < HORIZON ? HORIZON : plane.z;
    vec2 uv = plane.xy / inverse_w;
    return point_seen(
        position_from_pixel * pixel() / inverse_w,
        object_from_pixel * pixel() / inverse_w,
        vec2[4](uv, uv, uv, uv)
    );
}

// Whether the pixel shows the plane, and how far away: beyond the far plane depths go on below all
// others, nearer ones above farther ones in parallel views too.
bool on_plane() {
    float depth = dot(depth_from_pixel, pixel());
    gl_FragDepth = depth > 0.0 ? depth : BEYOND_FAR_PLANE * inverse_w / (1.0 - depth);
    return inverse_w > 0.0 && depth <= 1.0;
}
