// Where the eye meets a surface. Directions are unit vectors in world axes.
struct SurfacePoint {
    vec3 position;  // world axes, seen from the eye
    vec3 normal;    // on the eye's side of the surface
    vec3 view;      // towards the eye
    vec2 uv;        // the mesh's texture coordinates
};
