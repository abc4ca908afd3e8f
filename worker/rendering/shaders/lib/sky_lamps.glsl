#include "lib/lamps.glsl"

// The sky as lamps infinitely far away: their directions above, their irradiances below.
uniform sampler2D sky_lamps;
uniform int sky_lamp_count;
uniform mat3 sky_from_world;
uniform float sky_intensity;

Light sky_lamp(int index) {
    vec3 direction = texelFetch(sky_lamps, ivec2(index, 1), 0).xyz * sky_from_world;
    return Light(direction, sky_intensity * texelFetch(sky_lamps, ivec2(index, 0), 0).rgb);
}
