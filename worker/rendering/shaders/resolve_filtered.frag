#version 410 core
uniform sampler2D samples_0;
uniform int samples_per_side;
uniform float weights[24];  // of the samples in a pixel and its two neighbours along an axis
layout(location = 0) out vec4 pixel;

// The weighted mean of the samples in a pixel and round it; there is a pixel more on every side.
void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * samples_per_side;
    int across = 3 * samples_per_side;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < across; y++) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < across; x++)
            row += weights[x] * texelFetch(samples_0, corner + ivec2(x, y), 0);
        sum += weights[y] * row;
    }
    pixel = sum;
}
