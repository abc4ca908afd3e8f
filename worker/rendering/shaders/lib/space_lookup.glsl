#include "lib/reach.glsl"

// Where in a volume or on a cube map to look, and how far the pixel reaches there.
struct SpaceLookup {
    vec3 place;
    vec3 texel;     // the size of one, in the units of the place
    vec3 across_x;  // texels from this pixel's middle to the next one's on the right
    vec3 across_y;  // and to the one above
};

// period is that of u and v, and w has v's.
SpaceLookup look_up_space(Reach coordinates, mat3 transform, vec4 period, vec3 size) {
    Reach at = transformed(coordinates, transform);
    vec3 whole = period.xyy * floor(at.place * period.zww);
    return SpaceLookup(at.place - whole, 1.0 / size, size * at.across_x, size * at.across_y);
}

// On the cube from -1 to 1, whose faces have `size` texels along each side.
SpaceLookup look_up_cube(Reach direction, float size) {
    vec3 along = abs(direction.place);
    float largest = max(along.x, max(along.y, along.z));
    vec3 face = step(largest, along) * sign(direction.place);
    face *= 1.0 / max(dot(face, face), 1.0);  // on an edge, of both
    vec3 place = direction.place / largest;
    vec3 x = (direction.across_x - place * dot(face, direction.across_x)) / largest;
    vec3 y = (direction.across_y - place * dot(face, direction.across_y)) / largest;
    return SpaceLookup(place, vec3(2.0 / size), 0.5 * size * x, 0.5 * size * y);
}
