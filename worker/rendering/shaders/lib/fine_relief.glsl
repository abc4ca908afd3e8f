// Relief that is finer than a pixel widens highlights: the variance of its slopes along each axis is
// added to that of the little mirrors' (Toksvig 2005; Olano and Baker 2010).
float slope_variance = 0.0;
mat3 slope_covariance = mat3(0.0);  // of those besides that vary more in one direction, in the world

// A lobe of exp(-tan^2 d / alpha^2) or of GGX: the variance is alpha^2 / 2.
float widened(float alpha) {
    return slope_variance > 0.0 ? sqrt(alpha * alpha + 2.0 * slope_variance) : alpha;
}

// The same of a roughness, the root of alpha.
float roughened(float roughness) {
    float bounded = clamp(roughness, 0.0, 1.0);
    return slope_variance > 0.0 ? sqrt(min(widened(bounded * bounded), 1.0)) : roughness;
}

// A power of n.h, as wide as 1 / exponent.
float dulled(float exponent) {
    return exponent / (1.0 + exponent * slope_variance);
}

// A power of r.v: what is mirrored turns twice as far as the mirror.
float dulled_mirror(float exponent) {
    return exponent / (1.0 + 4.0 * exponent * slope_variance);
}
