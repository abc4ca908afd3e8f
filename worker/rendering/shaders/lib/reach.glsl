#include "lib/footprint.glsl"
#include "lib/surface_point.glsl"

// A vector at a pixel's middle, and its change to the next pixels' middles.
struct Reach {
    vec3 place;
    vec3 across_x;  // to the right
    vec3 across_y;  // upwards
};

// Of what was interpolated perspective-correctly. value / w and 1 / w are linear on the screen, so
// that their differences between pixels are derivatives, and the quotient rule gives those of the
// value at this very pixel (Heckbert 1989); a plain difference would be one between two pixels.
Reach reach_of(vec3 value) {
    float inverse = inverse_w();
    vec3 scaled = value * inverse;
    return Reach(
        value,
        (dFdx(scaled) - value * dFdx(inverse)) / inverse,
        (dFdy(scaled) - value * dFdy(inverse)) / inverse
    );
}

// Of a direction or whatever else was computed at each pixel. It has no seams.
Reach difference_of(vec3 value) {
    return Reach(value, dFdx(value), dFdy(value));
}

// The first two numbers, as a place on a picture.
Footprint flat_reach(Reach reach) {
    return Footprint(reach.place.xy, reach.across_x.xy, reach.across_y.xy);
}
