#include "lib/level_of_detail.glsl"
#include "lib/space_lookup.glsl"

// The filters of pictures (lib/sample_*.glsl) for volumes and cube maps.

vec4 sample_nearest(sampler3D picture, SpaceLookup at) {
    return textureLod(picture, at.place, 0.0);
}

vec4 sample_nearest(samplerCube picture, SpaceLookup at) {
    return textureLod(picture, at.place, 0.0);
}

vec4 sample_bilinear(sampler3D picture, SpaceLookup at) {
    return textureLod(picture, at.place, 0.0);
}

vec4 sample_bilinear(samplerCube picture, SpaceLookup at) {
    return textureLod(picture, at.place, 0.0);
}

float space_level(SpaceLookup at) {
    return level_for(max(length(at.across_x), length(at.across_y)));
}

vec4 sample_trilinear(sampler3D picture, SpaceLookup at) {
    return textureLod(picture, at.place, space_level(at));
}

vec4 sample_trilinear(samplerCube picture, SpaceLookup at) {
    return textureLod(picture, at.place, space_level(at));
}

// Probes in a row along the longer axis of the footprint, as lib/sample_anisotropic.glsl has them.
struct Probes {
    int count;
    vec3 stretch;  // from the first to the last and a step
    float level;
};

const int MOST_SPACE_PROBES = 16;

Probes space_probes(SpaceLookup at) {
    vec3 larger = max(abs(at.across_x), abs(at.across_y));
    float unit = max(larger.x, max(larger.y, larger.z));
    if (!(unit > 0.0 && unit < 1e18)) return Probes(1, vec3(0.0), unit < 1e18 ? 0.0 : COARSEST);
    vec3 x = at.across_x / unit, y = at.across_y / unit;
    // The longer axis is a x + b y, of the eigenvector (a, b) of the products of x and y.
    float xx = dot(x, x), xy = dot(x, y), yy = dot(y, y);
    float half_difference = 0.5 * (xx - yy);
    float root = sqrt(half_difference * half_difference + xy * xy);
    float major_squared = 0.5 * (xx + yy) + root;
    float major = unit * sqrt(major_squared);
    float minor = unit * length(cross(x, y)) / sqrt(major_squared);
    vec2 mixed = xx >= yy ? vec2(half_difference + root, xy) : vec2(xy, root - half_difference);
    vec3 axis = mixed.x * x + mixed.y * y;
    float width = max(max(minor, major / float(MOST_SPACE_PROBES)), 1.0);
    int count = clamp(int(ceil(major / width)), 1, MOST_SPACE_PROBES);
    vec3 stretch = count > 1 ? axis * (major / max(length(axis), 1e-30)) * at.texel : vec3(0.0);
    return Probes(count, stretch, level_for(width * 0.70710678));
}

vec4 sample_anisotropic(sampler3D picture, SpaceLookup at) {
    Probes probes = space_probes(at);
    vec4 mean = vec4(0.0);
    for (int i = 0; i < probes.count; i++) {
        float t = (float(i) + 0.5) / float(probes.count) - 0.5;
        vec4 texel = textureLod(picture, at.place + t * probes.stretch, probes.level);
        mean += (texel - mean) / float(i + 1);
    }
    return mean;
}

vec4 sample_anisotropic(samplerCube picture, SpaceLookup at) {
    Probes probes = space_probes(at);
    vec4 mean = vec4(0.0);
    for (int i = 0; i < probes.count; i++) {
        float t = (float(i) + 0.5) / float(probes.count) - 0.5;
        vec4 texel = textureLod(picture, at.place + t * probes.stretch, probes.level);
        mean += (texel - mean) / float(i + 1);
    }
    return mean;
}
