#include "lib/power.glsl"
#include "lib/lookup.glsl"

const float COARSEST = 32.0;

// log2 of a reach in texels; 0 for none, the coarsest level for one that is not finite.
float level_for(float reach) {
    return reach < 1e18 ? exact_log2(max(reach, 1.0)) : COARSEST;
}

// lambda = log2 max(|dP/dx|, |dP/dy|) (Williams 1983), 0 where the picture is magnified.
float level_of_detail(Lookup at) {
    return level_for(max(length(at.across_x), length(at.across_y)));
}
