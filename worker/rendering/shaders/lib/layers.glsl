#include "lib/frames.glsl"
#include "lib/lookup.glsl"
#include "lib/picture.glsl"
#include "lib/reach.glsl"
#include "lib/surface_point.glsl"

// What is known of a thing beside its light; worker/rendering/packing.py has the same table.
layout(location = 1) out vec4 layer_albedo;            // premultiplied; a = coverage
layout(location = 2) out vec4 layer_normal;            // a = depth
layout(location = 3) out vec4 layer_geometric_normal;  // a = object id
layout(location = 4) out vec4 layer_position;          // a = material id
layout(location = 5) out vec4 layer_tangent;
layout(location = 6) out vec4 layer_uv;                // b = texel density
layout(location = 7) out vec4 layer_footprint;

uniform vec3 view_axis;  // where the eye looks
uniform int object_id;
uniform int material_id;
uniform samplerBuffer face_normals;  // of each triangle, outward, in the object's frame
uniform bool has_faces;              // lines and points have none
uniform float samples_per_side;      // of a pixel

// The flat triangle's, on the eye's side; differences of positions from pixel to pixel would be
// good to 1e-4 only.
vec3 geometric_normal(SurfacePoint point) {
    if (!has_faces) return point.normal;
    vec3 outward = normalize(normal_from_object * texelFetch(face_normals, gl_PrimitiveID).xyz);
    return gl_FrontFacing ? outward : -outward;
}

// How many texels fit along a pixel, where both are stretched alike: the root of what its area
// holds.
float texel_density(Lookup at) {
    vec2 x = at.across_x * samples_per_side, y = at.across_y * samples_per_side;
    return sqrt(abs(x.x * y.y - x.y * y.x));
}

void write_layers(SurfacePoint point, vec3 albedo, float opacity, float density) {
    Reach uv = reach_of(vec3(point.uv[0], 0.0));
    layer_albedo = holdable(vec4(albedo * point.color.rgb * opacity, opacity));
    layer_normal = holdable(vec4(point.normal, dot(point.position, view_axis)));
    layer_geometric_normal = holdable(vec4(geometric_normal(point), float(object_id)));
    layer_position = holdable(vec4(eye_position + point.position, float(material_id)));
    layer_tangent = holdable(vec4(normalize(point.tangent.xyz), 0.0));
    layer_uv = holdable(vec4(point.uv[0], density, 0.0));
    layer_footprint = holdable(vec4(uv.across_x.xy, uv.across_y.xy) * samples_per_side);
}
