// Logarithm and power to float32 precision; a GL's own may be good to 1e-4 only.

const float SQRT_2 = 1.41421356;

// Base 2, of a positive normal number: the exponent's bits plus the series of atanh.
float exact_log2(float x) {
    int bits = floatBitsToInt(x);
    int exponent = (bits >> 23) - 127;
    float mantissa = intBitsToFloat((bits & 0x7fffff) | 0x3f800000);
    bool upper = mantissa > SQRT_2;
    mantissa = upper ? 0.5 * mantissa : mantissa;
    exponent = upper ? exponent + 1 : exponent;
    float s = (mantissa - 1.0) / (mantissa + 1.0);
    float t = s * s;
    float series = 1.0 + t * (1.0 / 3.0 + t * (1.0 / 5.0 + t * (1.0 / 7.0 + t * (1.0 / 9.0))));
    return float(exponent) + 2.88539008 * s * series;
}

// 2^y for y <= 127; nothing below the smallest normal number.
float exact_exp2(float y) {
    float bounded = max(y, -126.0);
    float whole = floor(bounded + 0.5);
    float x = (bounded - whole) * 0.693147181;
    float series = 1.0 + x * (1.0 + x * (1.0 / 2.0 + x * (1.0 / 6.0 + x * (1.0 / 24.0
        + x * (1.0 / 120.0 + x * (1.0 / 720.0 + x * (1.0 / 5040.0)))))));
    return y < -126.0 ? 0.0 : series * intBitsToFloat((int(whole) + 127) << 23);
}

// x^n for x in 0..1 and n >= 0, with 0^0 = 1.
float exact_power(float x, float n) {
    float power = x < 1.17549435e-38 ? 0.0 : exact_exp2(n * exact_log2(x));
    return n == 0.0 ? 1.0 : power;
}
