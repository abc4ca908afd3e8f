layout(location = 0) out vec4 color;

const float LARGEST = 5e36;  // 64 samples of it, a pixel's, still add up to a number

// Light that a picture can hold: the rest is cut off, and what is no number is dark.
vec4 holdable(vec4 light) {
    return mix(clamp(light, -LARGEST, LARGEST), vec4(0.0), isnan(light));
}
