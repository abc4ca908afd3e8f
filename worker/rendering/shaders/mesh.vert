#version 410 core
layout(location = 0) in vec3 mesh_position;
layout(location = 1) in vec3 mesh_normal;
layout(location = 2) in vec4 mesh_tangent;
layout(location = 3) in vec4 mesh_color;
layout(location = 4) in vec2 mesh_uv_0;
layout(location = 5) in vec2 mesh_uv_1;
layout(location = 6) in vec2 mesh_uv_2;
layout(location = 7) in vec2 mesh_uv_3;
uniform mat4 clip_from_object;
uniform mat4 eye_from_object;  // axes of the world, origin at the eye: small numbers stay exact
uniform mat3 normal_from_object;
uniform float handedness;  // -1 where the transform mirrors, else 1
out vec3 vertex_position;
out vec3 vertex_object_position;
out vec3 vertex_normal;
out vec4 vertex_tangent;
out vec4 vertex_color;
out vec2 vertex_uv_0;
out vec2 vertex_uv_1;
out vec2 vertex_uv_2;
out vec2 vertex_uv_3;
noperspective out vec2 flat_uv_0;  // linear on the screen
noperspective out vec2 flat_uv_1;
noperspective out vec2 flat_uv_2;
noperspective out vec2 flat_uv_3;

// Unit length, or none where there is none; the largest component is taken out lest squares vanish.
vec3 direction_of(vec3 vector) {
    vec3 size = abs(vector);
    float largest = max(size.x, max(size.y, size.z));
    return largest > 0.0 ? normalize(vector / largest) : vec3(0.0);
}

// What the surface does not use, the compiler leaves out here too.
void main() {
    vertex_position = (eye_from_object * vec4(mesh_position, 1.0)).xyz;
    vertex_object_position = mesh_position;
    vertex_normal = direction_of(normal_from_object * mesh_normal);
    vec3 tangent = direction_of(mat3(eye_from_object) * mesh_tangent.xyz);
    vertex_tangent = vec4(tangent, handedness * mesh_tangent.w);
    vertex_color = mesh_color;
    vertex_uv_0 = mesh_uv_0;
    vertex_uv_1 = mesh_uv_1;
    vertex_uv_2 = mesh_uv_2;
    vertex_uv_3 = mesh_uv_3;
    flat_uv_0 = mesh_uv_0;
    flat_uv_1 = mesh_uv_1;
    flat_uv_2 = mesh_uv_2;
    flat_uv_3 = mesh_uv_3;
    gl_Position = clip_from_object * vec4(mesh_position, 1.0);
}
