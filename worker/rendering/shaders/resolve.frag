#version 410 core
uniform sampler2D samples_0;
uniform int samples_per_side;
layout(location = 0) out vec4 pixel;

// The mean of a pixel's samples (box filter), row by row.
void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * samples_per_side;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < samples_per_side; y++)
        for (int x = 0; x < samples_per_side; x++)
            sum += texelFetch(samples_0, corner + ivec2(x, y), 0);
    pixel = sum / float(samples_per_side * samples_per_side);
}
