#include "lib/frames.glsl"
#include "lib/power.glsl"

// Three places on a picture, and how much each counts.
struct Triplanar {
    Footprint along_x;
    Footprint along_y;
    Footprint along_z;
    vec3 weights;
};

Footprint projected(Reach place, vec3 right, vec3 up) {
    return Footprint(
        vec2(dot(place.place, right), dot(place.place, up)),
        vec2(dot(place.across_x, right), dot(place.across_x, up)),
        vec2(dot(place.across_y, right), dot(place.across_y, up))
    );
}

// w = |n|^k / sum |n|^k (Geiss 2007), by the largest lest all vanish. Each picture is turned to the
// side it is seen from.
Triplanar coordinates_triplanar(SurfacePoint point, float sharpness, const int frame) {
    Reach place = position_in(point, frame);
    vec3 normal = normal_in(point.outer_normal, frame).place;
    vec3 size = abs(normal);
    size /= max(max(size.x, max(size.y, size.z)), 1e-30);
    vec3 weights = vec3(
        exact_power(size.x, sharpness), exact_power(size.y, sharpness), exact_power(size.z, sharpness)
    );
    vec3 side = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(normal, vec3(0.0)));
    return Triplanar(
        projected(place, vec3(0.0, 0.0, -side.x), vec3(0.0, 1.0, 0.0)),
        projected(place, vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, -side.y)),
        projected(place, vec3(side.z, 0.0, 0.0), vec3(0.0, 1.0, 0.0)),
        weights / (weights.x + weights.y + weights.z)
    );
}
