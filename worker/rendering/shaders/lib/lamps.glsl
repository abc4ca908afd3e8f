#include "lib/surface_point.glsl"

// Lamps as they shine, whatever stands between: directional, point and spot lights in one form.
uniform int light_count;
uniform vec4 light_position[32];  // from the eye, w = 1; or the direction towards the light, w = 0
uniform vec4 light_color[32];     // irradiance or radiant intensity; a = offset of the cone's edge
uniform vec4 light_axis[32];      // where the cone points; w = slope of the cone's edge

struct Light {
    vec3 direction;   // towards the light
    vec3 irradiance;  // on a surface that faces it
};

// The cone fades as KHR_lights_punctual says; a light without a cone has slope 0 and offset 1.
Light lamp_at(int index, SurfacePoint point) {
    vec4 place = light_position[index];
    vec3 way = place.xyz - point.position * place.w;
    float distance_squared = place.w == 0.0 ? 1.0 : dot(way, way);
    vec3 direction = normalize(way);
    float cone = clamp(
        dot(-direction, light_axis[index].xyz) * light_axis[index].w + light_color[index].a, 0.0, 1.0
    );
    return Light(direction, light_color[index].rgb * (cone * cone / distance_squared));
}
