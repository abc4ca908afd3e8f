#include "lib/extent.glsl"
#include "lib/lattice.glsl"

const float FINEST_LIMIT = 512.0;

// How much of a wave is kept. window: 0 all, 1 Fejer, 2 Lanczos, 3 Gaussian; share: 0..1.
float kept_wave(float share, int window) {
    float angle = 3.14159265 * share;
    if (window == 1) return 1.0 - share;
    if (window == 2) return angle < 1e-3 ? 1.0 : sin(angle) / angle;
    if (window == 3) return exp(-4.5 * share * share);
    return 1.0;
}

// S = 4/pi sum of sin(k pi x) / k over odd k below a limit, 0 for the finest that the reach holds.
float square_wave(float place, int cells, float reach, float band_limit, int window) {
    LatticePlace at = lattice_place(place, cells, 0.0);
    float x = at.offset + float(at.cell & 1);
    float limit = band_limit > 0.0
        ? band_limit : 1.0 / max(reach * float(cells), 1.0 / FINEST_LIMIT);
    float sum = 0.0;
    for (float k = 1.0; k < limit; k += 2.0) {
        float swing = k * x;
        float turn = swing - 2.0 * floor(0.5 * swing);
        sum += kept_wave(k / limit, window) / k * sin(3.14159265 * turn);
    }
    return 1.27323954 * sum;
}

// Squares of two colours (Hughes et al. 2013, exercise 20.3) of no finer waves than a limit.
vec4 texture_band_limited_checkerboard(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    vec2 cells,
    vec3 first,
    vec3 second,
    float band_limit,
    int window
) {
    vec3 reach = pixel_box(across_x, across_y);
    float sign = square_wave(place.x, int(cells.x), reach.x, band_limit, window)
        * square_wave(place.y, int(cells.y), reach.y, band_limit, window);
    return vec4(mix(second, first, 0.5 + 0.5 * sign), 1.0);
}
