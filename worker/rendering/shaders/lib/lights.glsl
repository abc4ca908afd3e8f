#include "lib/surface_point.glsl"

// Light that arrives at a point: directional, point and spot lights in one form.
uniform int light_count;
uniform vec4 light_position[32];  // from the eye, w = 1; or the direction towards the light, w = 0
uniform vec4 light_color[32];     // irradiance or radiant intensity; a = offset of the cone's edge
uniform vec4 light_axis[32];      // where the cone points; w = slope of the cone's edge
uniform vec3 ambient_radiance;
vec3 baked_radiance = vec3(0.0);  // of a light map, where the surface has one

// Light that arrives from everywhere alike.
vec3 light_all_around() {
    return ambient_radiance + baked_radiance;
}

// What part of a light's colours comes through to a point; each program brings its own.
vec3 let_through(int light, SurfacePoint point);
float seen_by_light(int light, SurfacePoint point);  // of that, what no shadow takes

struct Light {
    vec3 direction;   // towards the light
    vec3 irradiance;  // on a surface that faces it
};

// Light on its way to the point, whatever stands between. The cone fades as KHR_lights_punctual
// says; a light without a cone has slope 0 and offset 1.
Light light_towards(int index, SurfacePoint point) {
    vec4 place = light_position[index];
    vec3 way = place.xyz - point.position * place.w;
    float distance_squared = place.w == 0.0 ? 1.0 : dot(way, way);
    vec3 direction = normalize(way);
    float cone = clamp(
        dot(-direction, light_axis[index].xyz) * light_axis[index].w + light_color[index].a, 0.0, 1.0
    );
    return Light(direction, light_color[index].rgb * (cone * cone / distance_squared));
}

Light light_at(int index, SurfacePoint point) {
    Light light = light_towards(index, point);
    light.irradiance *= let_through(index, point);
    return light;
}
