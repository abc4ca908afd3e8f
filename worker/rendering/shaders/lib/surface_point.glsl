// Where the eye meets a surface. Directions are unit vectors in world axes.
struct SurfacePoint {
    vec3 position;         // world axes, seen from the eye
    vec3 object_position;  // in the mesh's own frame
    vec3 normal;           // on the eye's side; none, (0, 0, 0), of lines and points without
    vec3 smooth_normal;    // the same, but never tilted by a normal map
    vec3 outer_normal;     // the same on the outer side, whichever is seen
    vec3 view;             // towards the eye
    vec4 tangent;          // as interpolated: where u grows, and the bitangent's sign
    vec4 color;            // the mesh's, white if it has none
    vec2 uv[4];            // the mesh's texture coordinates, each set
};

