// Rough surfaces as many small mirrors: GGX (Walter et al. 2007) with Smith shadowing of light and
// view together (Heitz 2014), and Schlick's Fresnel term (1994), as glTF 2.0, appendix B, has them.

const float SMOOTHEST = 1e-4;  // alpha; below, n.h in float32 is too coarse for the peak

float alpha_of(float roughness) {
    float bounded = clamp(roughness, 0.0, 1.0);
    return max(bounded * bounded, SMOOTHEST);
}

// (1 - x)^5 for x in 0..1.
float schlick(float x) {
    float rest = 1.0 - clamp(x, 0.0, 1.0);
    float squared = rest * rest;
    return squared * squared * rest;
}

// D V n.l with V = G / (4 n.l n.v), 0 where the light does not face the surface.
// |n x h|^2 keeps the digits of the peak, which 1 - (n.h)^2 loses.
float highlight(vec3 normal, vec3 half_way, float facing, float seen, float alpha) {
    float a2 = alpha * alpha;
    vec3 sine = cross(normal, half_way);
    float cosine = dot(normal, half_way);
    float spread = dot(sine, sine) + a2 * cosine * cosine;
    float light_side = seen * sqrt(facing * facing * (1.0 - a2) + a2);
    float view_side = facing * sqrt(seen * seen * (1.0 - a2) + a2);
    float shadowed = 0.5 * facing / max(light_side + view_side, 1e-30);
    return a2 / (3.14159265 * spread * spread) * shadowed;
}
