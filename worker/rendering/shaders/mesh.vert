#version 410 core
layout(location = 0) in vec3 mesh_position;
layout(location = 1) in vec3 mesh_normal;
layout(location = 2) in vec2 mesh_uv;
uniform mat4 clip_from_object;
uniform mat4 eye_from_object;  // axes of the world, origin at the eye: small numbers stay exact
uniform mat3 normal_from_object;
out vec3 vertex_position;
out vec3 vertex_normal;
out vec2 vertex_uv;

void main() {
    vertex_position = (eye_from_object * vec4(mesh_position, 1.0)).xyz;
    vertex_normal = normal_from_object * mesh_normal;
    vertex_uv = mesh_uv;
    gl_Position = clip_from_object * vec4(mesh_position, 1.0);
}
