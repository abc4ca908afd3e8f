#include "coordinates/triplanar.glsl"
#include "lib/parallax.glsl"

Triplanar moved(Triplanar sides, vec2 pixels) {
    return Triplanar(
        moved(sides.along_x, pixels),
        moved(sides.along_y, pixels),
        moved(sides.along_z, pixels),
        sides.weights
    );
}
