#include "lib/reach.glsl"

vec3 octahedral_signs(vec3 vector) {
    return mix(vec3(-1.0), vec3(1.0), greaterThanEqual(vector, vec3(0.0)));
}

// The change of a place on the octahedron's square with that of a direction.
vec2 octahedral_change(vec3 direction, vec3 change) {
    vec3 signs = octahedral_signs(direction);
    float size = dot(abs(direction), vec3(1.0));
    vec2 flat_change = (change.xy - direction.xy * (dot(signs, change) / size)) / size;
    return direction.z < 0.0 ? -signs.x * signs.y * flat_change.yx : flat_change;
}

// Directions on an octahedron, unfolded into a square (Praun and Hoppe 2003).
Footprint layout_octahedral(Reach direction) {
    vec3 place = direction.place / dot(abs(direction.place), vec3(1.0));
    vec2 folded = (1.0 - abs(place.yx)) * octahedral_signs(place).xy;
    return Footprint(
        0.5 + 0.5 * (place.z < 0.0 ? folded : place.xy),
        0.5 * octahedral_change(direction.place, direction.across_x),
        0.5 * octahedral_change(direction.place, direction.across_y)
    );
}
