#include "lib/fragment.glsl"

// What is known of a thing beside its light; worker/rendering/packing.py has the same table.
layout(location = 1) out vec4 layer_albedo;            // premultiplied; a = coverage
layout(location = 2) out vec4 layer_normal;            // a = depth
layout(location = 3) out vec4 layer_geometric_normal;  // a = object id
layout(location = 4) out vec4 layer_position;          // a = material id
layout(location = 5) out vec4 layer_tangent;
layout(location = 6) out vec4 layer_uv;

uniform vec3 eye_position;  // in the world
uniform vec3 view_axis;     // where the eye looks
uniform int object_id;
uniform int material_id;
uniform mat3 normal_from_object;
uniform samplerBuffer mesh_vertices;  // numbers one by one, each vertex beginning with its position
uniform usamplerBuffer mesh_indices;
uniform int mesh_stride;  // numbers from one vertex to the next; 0 where there are no triangles

vec3 corner(int index) {
    int start = int(texelFetch(mesh_indices, 3 * gl_PrimitiveID + index).r) * mesh_stride;
    return vec3(
        texelFetch(mesh_vertices, start).r,
        texelFetch(mesh_vertices, start + 1).r,
        texelFetch(mesh_vertices, start + 2).r
    );
}

// The flat triangle's, on the eye's side, from its corners: differences of positions from pixel to
// pixel would be good to 1e-4 only.
vec3 geometric_normal(SurfacePoint point) {
    if (mesh_stride == 0) return point.normal;
    vec3 origin = corner(0);
    vec3 outward = normal_from_object * cross(corner(1) - origin, corner(2) - origin);
    vec3 size = abs(outward);
    outward = normalize(outward / max(size.x, max(size.y, size.z)));  // lest squares vanish
    return gl_FrontFacing ? outward : -outward;
}

void write_layers(SurfacePoint point, vec3 albedo, float opacity) {
    layer_albedo = holdable(vec4(albedo * opacity, opacity));
    layer_normal = holdable(vec4(point.normal, dot(point.position, view_axis)));
    layer_geometric_normal = holdable(vec4(geometric_normal(point), float(object_id)));
    layer_position = holdable(vec4(eye_position + point.position, float(material_id)));
    layer_tangent = vec4(0.0);
    layer_uv = holdable(vec4(point.uv, 0.0, 0.0));
}
