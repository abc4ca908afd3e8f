#include "lib/extent.glsl"
#include "lib/gradient_noise.glsl"

const int FBM = 0, TURBULENCE = 1, RIDGED = 2, MULTIFRACTAL = 3;

// Octaves of gradient noise (Perlin 1985, Musgrave 1994), each faded where the pixel cannot show it.
// table: the permutation.
// set: of gradients, which also says how many axes there are.
// kind: how octaves come together.
// share: of the first octave; the gain for a multifractal.
// moments: of each octave, see gradient_noise.
// start, rest, scale, bias: the empty sum, what an octave adds that is not seen, and the end.
vec4 texture_perlin(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    vec4 table[64],
    float fade[5],
    int set,
    int kind,
    int octaves,
    int frequency,
    int lacunarity,
    float gain,
    float share,
    float depth,
    vec3 moments[16],
    float start,
    float rest,
    float scale,
    float bias
) {
    float total = start, carried = 1.0;
    int cells = frequency;
    for (int n = 0; n < octaves; n++) {
        float visible = visibility(float(cells), across_x, across_y);
        float noise = 0.0;
        if (visible > 0.0) {
            // One step of the R2 sequence (Roberts 2018), in 256ths
            vec2 shift = vec2(193 * n & 255, 145 * n & 255) / 256.0;
            LatticePlace at[3];
            at[0] = lattice_place(place.x, cells, shift.x);
            at[1] = lattice_place(place.y, cells, shift.y);
            at[2] = lattice_place(place.z + depth, cells, 0.0);
            noise = gradient_noise(table, set, fade, at, n, cells, moments[n]);
        }
        if (kind == FBM) {
            total += share * visible * noise;
        } else if (kind == TURBULENCE) {
            total += share * mix(rest, abs(noise), visible);
        } else if (kind == RIDGED) {
            float crest = 1.0 - abs(noise);
            float term = carried * mix(rest, crest * crest, visible);
            total += share * term;
            carried = clamp(2.0 * term, 0.0, 1.0);
        } else {
            total *= 1.0 + share * visible * noise;
        }
        share *= gain;
        // Finer ones cannot be seen either, and their number may not fit
        cells = visible > 0.0 ? cells * lacunarity : 1 << 19;
    }
    return vec4(vec3(scale * total + bias), 1.0);
}
