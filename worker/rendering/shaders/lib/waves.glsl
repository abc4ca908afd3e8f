// Turns of a wave at a place: a whole number of swings per tile, in two halves as of a lattice.
float turns(float place, float swings) {
    float coarse = floor(place * 4096.0);
    int step = int(coarse - 4096.0 * floor(coarse / 4096.0));
    return float(step * int(swings) & 4095) / 4096.0 + (place - coarse / 4096.0) * swings;
}

// sin(pi x) / (pi x)
float sinc(float x) {
    float angle = 3.14159265 * x;
    return abs(angle) < 1e-3 ? 1.0 - angle * angle / 6.0 : sin(angle) / angle;
}
