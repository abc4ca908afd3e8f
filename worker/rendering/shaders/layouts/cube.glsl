#include "lib/reach.glsl"

// A cube's faces are a cube map of their own, mirrored as OpenGL wants them, and a direction leads
// there by itself.
Reach layout_cube(Reach direction) {
    return direction;
}
