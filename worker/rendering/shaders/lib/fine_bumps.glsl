#include "lib/fine_relief.glsl"
uniform float bump_steeper;

// Of the mean slopes along both axes and the mean of their squares' sum (Olano and Baker 2010), both
// axes taken together.
float variance_of_bumps(vec3 moments) {
    float variance = 0.5 * bump_steeper * bump_steeper * (moments.z - dot(moments.xy, moments.xy));
    return variance > 0.0 ? min(variance, 1e6) : 0.0;
}
