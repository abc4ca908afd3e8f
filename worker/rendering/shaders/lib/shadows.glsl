#include "lib/surface_point.glsl"

// Shadow maps (Williams 1978): what a light sees nearest, in texels of one array for all lights.
// worker/rendering/light_views.py lays them out.
uniform sampler2DArray shadow_maps;   // reversed depth, 0 where nothing is
uniform vec4 shadow_across[32];       // the light's axes; w: the eye's place along them
uniform vec4 shadow_up[32];
uniform vec4 shadow_along[32];
uniform vec4 shadow_lens[32];   // focal in texels, reach or near, 1 if parallel, 1 if all round
uniform vec4 shadow_map[32];    // layer or -1, resolution, radius, bias

const float SLANTEST = 0.02;  // cosine below which a surface counts as less slanted than it is

// The share of a light's rays that reach the point: the mean over a square of texels, each asked
// whether the plane that touches the surface lies before what the light sees there. So a flat
// surface cannot shade itself, however slanted.
float unshaded(int light, vec3 position, vec3 normal) {
    vec4 map = shadow_map[light];
    if (map.x < 0.0) return 1.0;
    vec4 lens = shadow_lens[light];
    mat3 world_from_light =
        mat3(shadow_across[light].xyz, shadow_up[light].xyz, shadow_along[light].xyz);
    vec3 eye = vec3(shadow_across[light].w, shadow_up[light].w, shadow_along[light].w);
    vec3 place = position * world_from_light + eye;
    vec3 facing = normal * world_from_light;
    int layer = int(map.x);
    if (lens.w > 0.0) {
        vec3 size = abs(place);
        int axis = size.x >= max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        if (axis == 0) { place = place.yzx; facing = facing.yzx; }
        if (axis == 1) { place = place.zxy; facing = facing.zxy; }
        layer += 2 * axis + (place.z < 0.0 ? 1 : 0);
        facing.z = place.z < 0.0 ? -facing.z : facing.z;
        place.z = abs(place.z);
    }
    bool parallel = lens.z > 0.0;
    float texel = parallel ? 1.0 / lens.x : place.z / lens.x;
    place += facing * (map.w * texel);
    // Over the plane n.q = c, 1 / z (seen from a point) or z (in parallel light) is affine in texels.
    vec2 at;
    vec2 slope;
    float depth;
    if (parallel) {
        at = place.xy * lens.x;
        depth = 1.0 - place.z / lens.y;
        slope = facing.xy / (min(facing.z, -SLANTEST) * lens.x * lens.y);
    } else {
        float z = max(place.z, 1e-30);
        at = place.xy / z * lens.x;
        depth = lens.y / z;
        float offset = min(dot(facing, place), -SLANTEST * length(place));
        slope = facing.xy * (lens.y / (offset * lens.x));
    }
    at += 0.5 * map.y;
    int radius = int(map.z);
    vec2 first = floor(at - 0.5) - float(radius);
    vec2 rest = fract(at - 0.5);
    float last = map.y - 1.0;
    float dark = 0.0;
    for (int y = 0; y <= 2 * radius + 1; y++) {
        float row = y == 0 ? 1.0 - rest.y : y == 2 * radius + 1 ? rest.y : 1.0;
        for (int x = 0; x <= 2 * radius + 1; x++) {
            float column = x == 0 ? 1.0 - rest.x : x == 2 * radius + 1 ? rest.x : 1.0;
            vec2 tap = clamp(first + vec2(x, y), 0.0, last);
            float before = max(depth + dot(slope, tap + 0.5 - at), 0.0);
            float seen = texelFetch(shadow_maps, ivec3(tap, layer), 0).r;
            dark += before >= seen ? 0.0 : row * column;
        }
    }
    float lit = 1.0 - dark / float((2 * radius + 1) * (2 * radius + 1));
    return lit < 1e-5 ? 0.0 : lit;  // what all texels hide gets nothing, rounding or not
}
