#include "lib/reach.glsl"

// Longitude and latitude (Blinn and Newell 1976): worker/layouts/latlong.py is the same.
//   centre: 0 is +z in the middle of the picture, 1 is +x, 2 is -z, 3 is -x

const float LATLONG_PI = 3.14159265;

// Towards the middle of the picture, and to its right.
vec2 latlong_axes(vec3 direction, int centre) {
    vec2 ground = centre == 0 || centre == 2 ? vec2(direction.z, -direction.x) : direction.xz;
    return centre < 2 ? ground : -ground;
}

vec2 layout_latlong(vec3 direction, const int centre) {
    vec2 ground = latlong_axes(direction, centre);
    float u = 0.5 + atan(ground.y, ground.x) / (2.0 * LATLONG_PI);
    return vec2(u - floor(u), 0.5 + atan(direction.y, length(ground)) / LATLONG_PI);
}

// The change of u comes from the direction's, which has no seam, and is a whole turn at most.
vec2 latlong_change(vec3 direction, vec3 change) {
    float across = length(direction.xz);
    float circle = max(across, length(direction) / 8.0);
    float u = direction.x * change.z - direction.z * change.x;
    float outwards = dot(direction.xz, change.xz) / across;
    float v = across * change.y - direction.y * outwards;
    float turn = 2.0 * LATLONG_PI;
    return vec2(
        clamp(u / (turn * max(across, 1e-30) * circle), -1.0, 1.0),
        v / (LATLONG_PI * dot(direction, direction))
    );
}

Footprint layout_latlong(Reach direction, const int centre) {
    return Footprint(
        layout_latlong(direction.place, centre),
        latlong_change(direction.place, direction.across_x),
        latlong_change(direction.place, direction.across_y)
    );
}
