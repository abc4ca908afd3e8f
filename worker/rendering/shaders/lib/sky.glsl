// Light from all around, beside the even one; each program brings its own, skies/*.glsl.

// What white chalk with this normal shows of it: irradiance over pi.
vec3 sky_on_matt(vec3 normal);

// What a mirror shows that the eye sees into this direction, from sharp (0) to dull (1).
//   reach: how far the direction changes from pixel to pixel
vec3 sky_in_mirror(vec3 direction, float reach, float roughness);

// How far a direction changes to the next pixels: where all of them run, as derivatives need it.
float reach_to(vec3 direction) {
    return max(length(dFdx(direction)), length(dFdy(direction)));
}
