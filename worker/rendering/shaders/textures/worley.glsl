#include "lib/counter_hash.glsl"
#include "lib/lattice.glsl"

// Shares of a Poisson process of density 1 with at most 0, 1, 2, .. points in a cell, times 2^32 and
// rounded up.
const uint POISSON[12] = uint[12](
    1580030169u, 3160060338u, 3950075422u, 4213413784u, 4279248374u, 4292415292u,
    4294609778u, 4294923277u, 4294962464u, 4294966818u, 4294967253u, 4294967293u
);
// Beyond this ring of cells there is nothing nearer: 17 x 17 cells without two points are unheard of
const int RINGS = 8;

// Distances in cells to scattered points (Worley 1996), in a plane or in space.
// keys: of the numbers of points, and of their places along each axis.
// lone: whether chance has left the tile without a point, so that its first cell has one.
vec4 texture_worley(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    int frequency,
    int flat_tile,
    int poisson,
    int lone,
    float jitter,
    int metric,
    int shown,
    vec4 keys[4]
) {
    LatticePlace at[3];
    for (int axis = 0; axis < 3; axis++) at[axis] = lattice_place(place[axis], frequency, 0.0);
    vec3 offset = vec3(at[0].offset, at[1].offset, flat_tile == 1 ? 0.0 : at[2].offset);
    vec3 sides = min(offset, 1.0 - offset);
    float margin = min(sides.x, sides.y);
    if (flat_tile == 0) margin = min(margin, sides.z);
    uint side = uint(frequency);
    uint cells = side * side * (flat_tile == 1 ? 1u : side);
    uvec2 key[4] = uvec2[4](key_64(keys[0]), key_64(keys[1]), key_64(keys[2]), key_64(keys[3]));
    float first = 1e30, second = 1e30;
    for (int ring = 0; ring <= RINGS; ring++) {
        float reach = float(ring - 1) + margin;
        if (ring > 0 && second <= (metric == 0 ? reach * reach : reach)) break;
        int deep = flat_tile == 1 ? 0 : ring;
        for (int k = -deep; k <= deep; k++) {
            for (int j = -ring; j <= ring; j++) {
                bool whole = abs(j) == ring || (abs(k) == ring && flat_tile == 0);
                for (int i = -ring; i <= ring; i += whole ? 1 : max(2 * ring, 1)) {
                    // RINGS turns keep the remainder's number positive
                    ivec3 cell = ivec3(at[0].cell + i, at[1].cell + j, at[2].cell + k);
                    cell = (cell + RINGS * frequency) % frequency;
                    uint index = (flat_tile == 1 ? 0u : uint(cell.z) * side) + uint(cell.y);
                    index = index * side + uint(cell.x);
                    int count = 1;
                    if (poisson == 1) {
                        uint chance = random_32(key[0], index, 0u, cells);
                        count = index == 0u ? lone : 0;
                        for (int n = 0; n < 12; n++) count += chance >= POISSON[n] ? 1 : 0;
                    }
                    for (int n = 0; n < count; n++) {
                        vec3 point = vec3(0.0);
                        for (int axis = 0; axis < 3 - flat_tile; axis++) {
                            uint number = random_32(key[1 + axis], index, uint(n), cells);
                            point[axis] = unit_float(number);
                        }
                        if (poisson == 0) point = 0.5 + jitter * (point - 0.5);
                        vec3 apart = abs(vec3(i, j, k) + point - offset);
                        if (flat_tile == 1) apart.z = 0.0;
                        float distance = metric == 0 ? dot(apart, apart)
                            : metric == 1 ? apart.x + apart.y + apart.z
                            : max(max(apart.x, apart.y), apart.z);
                        second = min(second, max(first, distance));
                        first = min(first, distance);
                    }
                }
            }
        }
    }
    if (metric == 0) {
        first = sqrt(first);
        second = sqrt(second);
    }
    float value = shown == 0 ? first : shown == 1 ? second : second - first;
    return vec4(vec3(value), 1.0);
}
