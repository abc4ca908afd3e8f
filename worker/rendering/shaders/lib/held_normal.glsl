uniform vec2 normal_range;
uniform vec4 normal_axes;

// What a normal map's texel means: x and y in the axes of u and v.
vec3 held_normal(vec4 texel) {
    vec3 held = normal_range.x * texel.xyz + normal_range.y;
    return vec3(dot(normal_axes.xy, held.xy), dot(normal_axes.zw, held.xy), held.z);
}
