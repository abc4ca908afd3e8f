#include "lib/box.glsl"
#include "lib/frames.glsl"
#include "lib/lights.glsl"
#include "lib/sky.glsl"
#include "lib/surface_point.glsl"

struct Surface {
    float density;
    float extinction;
    vec3 color;
    vec3 emission;
    float anisotropy;
    int steps;
    int light_steps;
};

float density_at(SurfacePoint point);  // the parameter at another point

const float THICKEST = 1e30;

// A point so far along a direction of the world, which is `way` in the mesh's own frame.
SurfacePoint further(SurfacePoint point, vec3 direction, vec3 way, float far) {
    point.position += far * direction;
    point.object_position += far * way;
    return point;
}

// What part of the light of a direction is scattered towards the eye, per unit of solid angle
// (Henyey and Greenstein 1941).
float scattered_part(float cosine, float anisotropy) {
    float squared = anisotropy * anisotropy;
    float below = max(1.0 + squared - 2.0 * anisotropy * cosine, 1e-4);
    return 0.0795774715 * (1.0 - squared) * inversesqrt(below) / below;
}

float thickness_at(SurfacePoint point, Surface surface) {
    float density = density_at(point);
    return isnan(density) ? 0.0 : min(max(density, 0.0) * surface.extinction, THICKEST);
}

// Light from all around is the mean of six directions' and is not weakened on its way in.
vec3 light_of_all_directions() {
    vec3 sum = vec3(0.0);
    for (int axis = 0; axis < 3; axis++) {
        vec3 along = vec3(axis == 0, axis == 1, axis == 2);
        sum += sky_on_matt(along) + sky_on_matt(-along);
    }
    return light_all_around() + sum / 6.0;
}

vec3 light_of_lamps(SurfacePoint point, Surface surface, mat3 object_from_world) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < light_total(); i++) {
        Light light = light_at(i, point);
        vec3 way = object_from_world * light.direction;
        float far = max(through_box(point.object_position, way).y, 0.0);
        if (light_position[i].w > 0.0) far = min(far, length(light_position[i].xyz - point.position));
        float each = far / float(max(surface.light_steps, 1));
        float thickness = 0.0;
        for (int j = 0; j < surface.light_steps; j++) {
            SurfacePoint before = further(point, light.direction, way, (float(j) + 0.5) * each);
            thickness += thickness_at(before, surface);
        }
        float part = scattered_part(-dot(light.direction, point.view), surface.anisotropy);
        sum += light.irradiance * (part * exp(-min(thickness * each, THICKEST)));
    }
    return sum;
}

// Follows the eye's ray through the box: from its outer side, or from the eye on where that is
// inside. Within a step the density is one, so that an even one is exact in any number of steps.
vec4 shade(SurfacePoint point, Surface surface) {
    mat3 object_from_world = inverse(mat3(eye_from_object));
    vec3 way = object_from_world * -point.view;
    vec2 ends = through_box(point.object_position, way);
    float eye_at = eye.w > 0.0 ? -length(point.position) : -THICKEST;
    bool inside = ends.x < eye_at;
    // The inner side is seen through the outer one, which has drawn it all
    int steps = gl_FrontFacing || inside ? surface.steps : 0;
    float entry = max(ends.x, eye_at);
    float each = max(ends.y - entry, 0.0) / float(surface.steps);
    point.normal = point.smooth_normal = vec3(0.0);
    vec3 everywhere = surface.emission + surface.color * light_of_all_directions();
    vec3 light = vec3(0.0);
    float thickness = 0.0, left = 1.0;
    for (int i = 0; i < steps; i++) {
        SurfacePoint here = further(point, -point.view, way, entry + (float(i) + 0.5) * each);
        thickness += min(thickness_at(here, surface) * each, THICKEST);
        float after = exp(-thickness);
        vec3 lamps = light_of_lamps(here, surface, object_from_world);
        light += (left - after) * (everywhere + surface.color * lamps);
        left = after;
    }
    return vec4(light * point.color.rgb, 1.0 - left);
}

vec3 albedo(Surface surface) {
    return surface.color;
}
