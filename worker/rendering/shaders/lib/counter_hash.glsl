// Numbers of 64 bits, the lower half in x.
uvec2 product_64(uvec2 a, uvec2 b) {
    uint low, high;
    umulExtended(a.x, b.x, high, low);
    return uvec2(low, high + a.x * b.y + a.y * b.x);
}

uvec2 shifted_64(uvec2 a, int bits) {
    return uvec2(a.x >> bits | a.y << (32 - bits), a.y >> bits);
}

// The finaliser of splitmix64 (Steele et al. 2014).
uvec2 mixed_64(uvec2 counter) {
    uvec2 state = product_64(counter, uvec2(0x7F4A7C15u, 0x9E3779B9u));
    state = product_64(state ^ shifted_64(state, 30), uvec2(0x1CE4E5B9u, 0xBF58476Du));
    state = product_64(state ^ shifted_64(state, 27), uvec2(0x133111EBu, 0x94D049BBu));
    return state ^ shifted_64(state, 31);
}

// A key of 64 bits from four whole numbers below 2^16, the lowest first.
uvec2 key_64(vec4 quarters) {
    uvec4 q = uvec4(quarters);
    return uvec2(q.x | q.y << 16, q.z | q.w << 16);
}

// The upper half of the random number of a counter, first + step * stride.
uint random_32(uvec2 key, uint first, uint step, uint stride) {
    uvec2 counter;
    umulExtended(step, stride, counter.y, counter.x);
    uint carry;
    counter.x = uaddCarry(counter.x, first, carry);
    counter.y += carry;
    return mixed_64(key ^ counter).y;
}

// 0..1
float unit_float(uint number) {
    return float(number >> 8) * 5.9604644775390625e-8;
}
