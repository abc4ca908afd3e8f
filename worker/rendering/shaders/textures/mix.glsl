// A blend of two textures (Porter and Duff 1984) by the first channel of a third.
vec4 texture_mix(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    vec4 a_value,
    vec4 b_value,
    vec4 amount_value
) {
    return mix(a_value, b_value, clamp(amount_value.r, 0.0, 1.0));
}
