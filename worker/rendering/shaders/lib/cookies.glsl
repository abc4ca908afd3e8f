#include "lib/lookup.glsl"
#include "lib/reach.glsl"

// Pictures before lights (Segal et al. 1992): p = P x, in units of the picture.
uniform mat4 cookie_from_eye[32];  // u w, v w and w of a place seen from the eye
uniform float cookie_picture[32];  // which picture, or -1

Footprint cookie_place(int light, vec3 position) {
    Reach at = reach_of(position);
    mat3 linear = mat3(cookie_from_eye[light]);
    vec3 place = (cookie_from_eye[light] * vec4(at.place, 1.0)).xyz;
    vec3 x = linear * at.across_x;
    vec3 y = linear * at.across_y;
    vec2 uv = place.xy / place.z;
    return Footprint(uv, (x.xy - uv * x.z) / place.z, (y.xy - uv * y.z) / place.z);
}
