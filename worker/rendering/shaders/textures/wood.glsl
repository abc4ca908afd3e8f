// Year rings (Peachey 1985), averaged over the pixel as if they were straight and undisturbed.
// across: 1 along the axes across the trunk, 0 along it.
vec4 texture_wood(
    vec3 place,
    vec3 across_x,
    vec3 across_y,
    vec4 noise_value,
    vec3 across,
    vec3 heart,
    float rings,
    float strength,
    float rest
) {
    float x = rings * length((place - heart) * across) + strength * (noise_value.r - rest);
    float part = x - floor(x);
    float half_width = 0.5 * min(rings * max(length(across_x), length(across_y)), 1.0);
    float over = max(max(half_width - part, part + half_width - 1.0), 0.0);
    float share = over > 0.0 ? over / (2.0 * half_width) : 0.0;
    return vec4(vec3(part < half_width ? part + share : part - share), 1.0);
}
