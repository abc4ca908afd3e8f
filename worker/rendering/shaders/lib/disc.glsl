#include "lib/reach.glsl"

// Discs on which the distance from the middle tells the angle from the forward direction:
// worker/layouts/_disc.py is the same. Directions are told as right, up and forward.
//   model: 0 equidistant, 1 equisolid, 2 stereographic, 3 orthographic
//   rim: the angle at the rim

const float DISC_QUARTER = 1.57079633;
const float DISC_HALF = 3.14159265;
const float DISC_OUTSIDE = 4.0;
// Where one direction is a whole rim, pictures are read no more coarsely along it than this.
const float DISC_STRETCH = 8.0;

// Distance from the middle, and its change with the angle.
vec2 disc_radius(float angle, const int model) {
    float half_sine = sin(0.5 * angle), half_cosine = cos(0.5 * angle);
    if (model == 1) return vec2(2.0 * half_sine, half_cosine);
    if (model == 2) return vec2(2.0 * half_sine / half_cosine, 1.0 / (half_cosine * half_cosine));
    if (model == 3) return vec2(sin(angle), cos(angle));
    return vec2(angle, 1.0);
}

vec2 disc_change(vec3 place, vec3 change, vec2 outwards, float across, vec2 slopes) {
    float away = dot(outwards, change.xy);
    float round = outwards.x * change.y - outwards.y * change.x;
    float angle = (place.z * away - across * change.z) / dot(place, place);
    return slopes.x * angle * outwards + slopes.y * round * vec2(-outwards.y, outwards.x);
}

// Places within the unit circle; what is beyond the rim is far outside.
Footprint disc_footprint(Reach local, const int model, float rim) {
    vec3 place = local.place;
    float across = length(place.xy), size = length(place);
    vec2 outwards = across > 0.0 ? place.xy / across : vec2(1.0, 0.0);
    float angle = atan(across, place.z);
    float whole = disc_radius(rim, model).x;
    vec2 radius = disc_radius(angle, model) / whole;
    float round = place.z > 0.0 && across < 1e-4 * size
        ? radius.y / size : radius.x / max(across, size / DISC_STRETCH);
    vec2 slopes = vec2(radius.y, round);
    float distance = angle > rim * 1.000001 ? DISC_OUTSIDE : radius.x;
    return Footprint(
        distance * outwards,
        disc_change(place, local.across_x, outwards, across, slopes),
        disc_change(place, local.across_y, outwards, across, slopes)
    );
}

// A disc that touches the sides of a square picture.
Footprint disc_picture(Reach local, const int model, float rim) {
    Footprint disc = disc_footprint(local, model, rim);
    return Footprint(0.5 + 0.5 * disc.place, 0.5 * disc.across_x, 0.5 * disc.across_y);
}

// Two discs side by side: the forward half, then the backward one.
//   flipped: 1 where right is left on the second disc
Footprint disc_pair(Reach local, const int model, const int flipped) {
    bool second = local.place.z < 0.0;
    vec3 side = second ? vec3(flipped == 1 ? -1.0 : 1.0, 1.0, -1.0) : vec3(1.0);
    Reach turned = Reach(side * local.place, side * local.across_x, side * local.across_y);
    Footprint disc = disc_picture(turned, model, DISC_QUARTER);
    vec2 squeeze = vec2(0.5, 1.0);
    return Footprint(
        squeeze * (disc.place + vec2(second ? 1.0 : 0.0, 0.0)),
        squeeze * disc.across_x,
        squeeze * disc.across_y
    );
}
