#include "lib/sky_lamps.glsl"
#include "skies/none.glsl"
