#include "lib/lamps.glsl"

// Light that arrives at a point.
uniform vec3 ambient_radiance;
vec3 baked_radiance = vec3(0.0);  // of a light map, where the surface has one

// Light that arrives from everywhere alike.
vec3 light_all_around() {
    return ambient_radiance + baked_radiance;
}

// What part of a light's colours comes through to a point; each program brings its own.
vec3 let_through(int light, SurfacePoint point);
float seen_by_light(int light, SurfacePoint point);  // of that, what no shadow takes

// Lamps, and the directions of a sky that is added up; each program brings its own.
int light_total();
Light light_at(int index, SurfacePoint point);

Light lamp_let_through(int index, SurfacePoint point) {
    Light light = lamp_at(index, point);
    light.irradiance *= let_through(index, point);
    return light;
}
