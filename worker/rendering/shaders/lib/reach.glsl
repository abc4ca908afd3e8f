#include "lib/footprint.glsl"

// 1 / w where the surface is, linear on the screen. A plane without end sets its own.
float inverse_w = gl_FragCoord.w;

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
    vec3 scaled = value * inverse_w;
    return Reach(
        value,
        (dFdx(scaled) - value * dFdx(inverse_w)) / inverse_w,
        (dFdy(scaled) - value * dFdy(inverse_w)) / inverse_w
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

// Moved as pictures are: the first two numbers by a matrix, the third left alone.
Reach transformed(Reach reach, mat3 transform) {
    mat3 linear = mat3(
        vec3(transform[0].xy, 0.0), vec3(transform[1].xy, 0.0), vec3(0.0, 0.0, 1.0)
    );
    return Reach(
        linear * reach.place + vec3(transform[2].xy, 0.0),
        linear * reach.across_x,
        linear * reach.across_y
    );
}

Reach transformed(Footprint at, mat3 transform) {
    return transformed(
        Reach(vec3(at.place, 0.0), vec3(at.across_x, 0.0), vec3(at.across_y, 0.0)), transform
    );
}
