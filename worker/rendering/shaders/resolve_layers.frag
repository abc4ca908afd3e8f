#version 410 core
// The attachments of lib/layers.glsl, behind the picture.
uniform sampler2D samples_0, samples_1, samples_2, samples_3, samples_4, samples_5, samples_6,
    samples_7;
uniform int samples_per_side;
uniform int apron;  // pixels more on every side
layout(location = 0) out vec4 picture;
layout(location = 1) out vec4 albedo;
layout(location = 2) out vec4 normal_and_depth;
layout(location = 3) out vec4 geometric_normal_and_object;
layout(location = 4) out vec4 position_and_material;
layout(location = 5) out vec4 tangent;
layout(location = 6) out vec4 uv_and_density;
layout(location = 7) out vec4 footprint;

const float NOWHERE = 1e10;     // the depth where nothing is
const float FARTHEST = 3.4e38;  // what is drawn is nearer

// Light is the mean of a pixel's samples, row by row. The mean of two things is none of them: what
// is known of a thing is that of the nearest sample that shows one, the first of equally near ones.
void main() {
    ivec2 corner = (ivec2(gl_FragCoord.xy) + apron) * samples_per_side;
    vec4 light = vec4(0.0), reflected = vec4(0.0);
    ivec2 nearest = corner;
    float depth = FARTHEST;
    for (int y = 0; y < samples_per_side; y++)
        for (int x = 0; x < samples_per_side; x++) {
            ivec2 place = corner + ivec2(x, y);
            light += texelFetch(samples_0, place, 0);
            reflected += texelFetch(samples_1, place, 0);
            float here = texelFetch(samples_2, place, 0).a;
            if (texelFetch(samples_3, place, 0).a > 0.0 && here < depth) {
                depth = here;
                nearest = place;
            }
        }
    float count = float(samples_per_side * samples_per_side);
    picture = light / count;
    albedo = reflected / count;
    normal_and_depth = texelFetch(samples_2, nearest, 0);
    normal_and_depth.a = depth < FARTHEST ? depth : NOWHERE;
    geometric_normal_and_object = texelFetch(samples_3, nearest, 0);
    position_and_material = texelFetch(samples_4, nearest, 0);
    tangent = texelFetch(samples_5, nearest, 0);
    uv_and_density = texelFetch(samples_6, nearest, 0);
    footprint = texelFetch(samples_7, nearest, 0);
}
