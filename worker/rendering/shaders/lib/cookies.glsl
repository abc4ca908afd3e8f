#include "lib/lookup.glsl"
#include "lib/reach.glsl"

// Pictures before lights (Segal et al. 1992): p = P x.
uniform mat4 cookie_from_eye[32];  // of a place seen from the eye
uniform float cookie_picture[32];  // which picture, or -1

// Of what a light throws u w, v w and w, in units of the picture; of what is all round it the way
// from the light to the point.
Reach cookie_ray(int light, vec3 position) {
    Reach at = reach_of(position);
    mat3 linear = mat3(cookie_from_eye[light]);
    vec3 place = (cookie_from_eye[light] * vec4(at.place, 1.0)).xyz;
    return Reach(place, linear * at.across_x, linear * at.across_y);
}

Footprint thrown(Reach ray) {
    vec2 uv = ray.place.xy / ray.place.z;
    vec3 x = ray.across_x, y = ray.across_y;
    return Footprint(uv, (x.xy - uv * x.z) / ray.place.z, (y.xy - uv * y.z) / ray.place.z);
}
