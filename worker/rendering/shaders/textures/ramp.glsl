// Colours along a line (Perlin 1985), picked by the first channel of a texture.
// interpolation: 0 straight, 1 with soft ends, 2 flat.
// positions: rising.
vec4 texture_ramp(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    vec4 input_value,
    int count,
    int interpolation,
    float positions[64],
    vec3 colors[64]
) {
    int upper = 0;
    while (upper < count && positions[upper] <= input_value.r) upper++;
    int lower = max(upper - 1, 0);
    if (interpolation == 2 || upper == 0 || upper == count) return vec4(colors[lower], 1.0);
    float share = (input_value.r - positions[lower]) / (positions[upper] - positions[lower]);
    if (interpolation == 1) share = share * share * (3.0 - 2.0 * share);
    return vec4(mix(colors[lower], colors[upper], share), 1.0);
}
