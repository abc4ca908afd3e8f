// One range of values taken to another along a curve; alpha stays, and colour is changed straight.
// input_range, output_range: first and last.
vec4 texture_levels(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    vec4 input_value,
    vec2 input_range,
    vec2 output_range,
    float exponent,
    int clamped
) {
    float alpha = input_value.a;
    vec3 value = (alpha > 0.0 ? input_value.rgb / alpha : vec3(0.0)) - input_range.x;
    float length = input_range.y - input_range.x;
    vec3 share = length == 0.0 ? step(0.0, value) : value / length;
    if (clamped == 1) share = clamp(share, 0.0, 1.0);
    if (exponent != 1.0) share = sign(share) * pow(abs(share), vec3(exponent));
    return vec4(mix(vec3(output_range.x), vec3(output_range.y), share) * alpha, alpha);
}
