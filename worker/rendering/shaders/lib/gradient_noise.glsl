#include "lib/lattice.glsl"

// Sets of gradients, in the order of GRADIENTS in worker/synthesis/_perlin_points.py
const int REFERENCE = 0, EIGHT = 1, SOLID = 2, TIME = 3;

// A permutation of 0..255, four numbers at a time.
int permuted(vec4 table[64], int index) {
    return int(table[index >> 2 & 63][index & 3]);
}

// cos(n pi / 4), exactly where it is whole.
float eighth_turn(int n) {
    int rise = abs(4 - (n & 7)) - 2;
    return abs(rise) == 2 ? float(sign(rise)) : float(sign(rise)) * 0.70710678;
}

// The product of a gradient and a distance: Perlin 2002 in his order, eight unit vectors, or the 32
// edges of a hypercube.
float gradient_height(int set, int number, vec4 p) {
    if (set == EIGHT) return eighth_turn(number) * p.x + eighth_turn(number - 2) * p.y;
    if (set == TIME) {
        int group = number >> 3 & 3;
        float a = group == 1 ? p.y : p.x;
        float b = group == 0 || group == 3 ? p.y : p.z;
        float c = group == 0 ? p.z : p.w;
        return ((number & 1) == 0 ? -a : a) + ((number & 2) == 0 ? -b : b)
            + ((number & 4) == 0 ? -c : c);
    }
    int h = number & 15;
    float u = h < 8 ? p.x : p.y;
    float v = h < 4 ? p.y : (h == 12 || h == 14 ? p.x : p.z);
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
}

float faded(float s, float fade[5]) {
    return s * (fade[0] + s * (fade[1] + s * (fade[2] + s * (fade[3] + s * fade[4]))));
}

// Noise with integer periods (Perlin, 1985 and 2002).
// layer: added to the third lattice index, which is 0 in a plane.
// moment: the two lattice indices along time, and how far between them.
float gradient_noise(
    vec4 table[64], int set, float fade[5], LatticePlace at[3], int layer, int period, vec3 moment
) {
    vec4 offset = vec4(at[0].offset, at[1].offset, 0.0, 0.0);
    vec4 blend = vec4(faded(offset.x, fade), faded(offset.y, fade), 0.0, 0.0);
    int corners = 4;
    if (set >= SOLID) {
        corners = 8;
        offset.z = at[2].offset;
        blend.z = faded(offset.z, fade);
    }
    if (set == TIME) {
        corners = 16;
        offset.w = moment.z;
        blend.w = faded(offset.w, fade);
    }
    float value = 0.0;
    for (int corner = 0; corner < corners; corner++) {
        ivec4 upper = ivec4(corner, corner >> 1, corner >> 2, corner >> 3) & 1;
        int number = permuted(table, (at[0].cell + upper.x) % period);
        number = permuted(table, number + (at[1].cell + upper.y) % period);
        int third = set >= SOLID ? (at[2].cell + upper.z) % period : 0;
        number = permuted(table, number + third + layer);
        if (set == TIME) number = permuted(table, number + int(upper.w == 1 ? moment.y : moment.x));
        vec4 share = mix(vec4(1.0) - blend, blend, vec4(upper));
        float weight = share.x * share.y;
        if (set >= SOLID) weight *= share.z;
        if (set == TIME) weight *= share.w;
        value += weight * gradient_height(set, number, offset - vec4(upper));
    }
    return value;
}
