#include "lib/picture.glsl"
#include "lib/surface_point.glsl"
uniform vec2 corner;        // of the tile in the whole picture, in samples from the lower left
uniform vec2 picture_size;  // width and height of the whole picture in samples

// A place on the picture, which is nowhere in the world: u to the right and v up, from 0 to 1.
SurfacePoint point_on_picture() {
    vec2 uv = (gl_FragCoord.xy + corner) / picture_size;
    vec3 towards_eye = vec3(0.0, 0.0, 1.0);
    return SurfacePoint(
        vec3(0.0),
        towards_eye,
        towards_eye,
        towards_eye,
        vec4(1.0),
        vec4(1.0),
        vec2[4](uv, uv, uv, uv)
    );
}
