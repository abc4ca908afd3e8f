#include "lib/scratches.glsl"
#include "lib/surface_point.glsl"

// The lobe of a rough mirror, of the same width in all directions or longer in one; each program
// brings its own, lobes/*.glsl.
struct Lobe {
    vec2 alpha;      // along and across
    Scratches axes;  // no two, where the lobe is round
};

//   strength: how much of the way to 1 alpha goes along the direction, as a square root
//   direction: in the axes of u and v, of any length
Lobe lobe_of(SurfacePoint point, float roughness, float strength, vec2 direction);

// What it reflects of light that is everywhere alike: A, B and A + B of F0 A + F90 B.
vec3 reflected_share(Lobe lobe, SurfacePoint point, float seen, float roughness);

// D V n.l, 0 where the light does not face the surface.
float highlight_of(Lobe lobe, SurfacePoint point, vec3 half_way, vec3 light, float facing, float seen);

// What it shows of the sky, as a mean.
vec3 sky_in_lobe(Lobe lobe, SurfacePoint point, vec3 mirrored, float reach, float roughness);
