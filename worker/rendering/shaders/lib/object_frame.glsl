uniform mat4 eye_from_object;  // axes of the world, origin at the eye
uniform mat3 normal_from_object;
