// Of a mirror whose lobe is about as wide as a power of the cosine: alpha^2 = 2 / (4 n + 2).
float roughness_of(float exponent) {
    return sqrt(sqrt(1.0 / (2.0 * exponent + 1.0)));
}
