#include "lib/fine_relief.glsl"

// How slopes vary about their means, from those of their products, xx, xy and yy (Olano and Baker
// 2010).
mat2 covariance_of(vec3 products, vec2 means) {
    vec3 apart = products - vec3(means.x * means, means.y * means.y);
    float x = apart.x > 0.0 ? min(apart.x, 1e6) : 0.0;
    float y = apart.z > 0.0 ? min(apart.z, 1e6) : 0.0;
    float most = sqrt(x * y);
    float both = apart.y > -most ? min(apart.y, most) : apart.y < 0.0 ? -most : 0.0;
    return mat2(x, both, both, y);
}

// The same of what those slopes add to the unit normal, of which `ways` is what each one does.
mat3 spread_along(mat2x3 ways, mat2 covariance) {
    return ways * covariance * transpose(ways);
}

// The mean over all directions in the surface.
float even_variance(mat3 covariance) {
    return 0.5 * (covariance[0].x + covariance[1].y + covariance[2].z);
}
