#include "lib/fine_relief.glsl"
uniform float normal_steeper;

// Unit normals with a variance of s along both axes have a mean of length 1 / (1 + s) (Toksvig
// 2005).
float variance_of_normals(vec3 mean) {
    float size = clamp(length(mean), 1e-3, 1.0);
    return normal_steeper * normal_steeper * (1.0 - size) / size;
}
