#include "lib/upright_reach.glsl"

// Where an interval of texels starts and ends: its ends' texels, how far into them, and how many
// whole pictures lie between, where pictures repeat. Without a repeat the outermost texels go on.
struct Interval {
    ivec2 texel;
    vec2 part;
    float pictures;
};

Interval interval(float start, float end, int count, bool repeats) {
    vec2 ends = vec2(start, end);
    vec2 rounds = repeats ? floor(ends / float(count)) : vec2(0.0);
    ends -= rounds * float(count);
    vec2 texel = clamp(floor(ends), 0.0, float(count - 1));
    return Interval(ivec2(texel), ends - texel, rounds.y - rounds.x);
}

// The sum of what lies between two rows of corners, over an interval. Near sums are subtracted
// first, which is exact; what is left is small enough to keep its digits.
vec4 between(sampler2D table, Interval columns, int row, int upper, int last) {
    vec4 sums[5];
    int x[5] = int[5](
        columns.texel.x, columns.texel.x + 1, columns.texel.y, columns.texel.y + 1, last
    );
    for (int i = 0; i < 5; i++)
        sums[i] = texelFetch(table, ivec2(x[i], upper), 0) - texelFetch(table, ivec2(x[i], row), 0);
    return (sums[2] - sums[0]) + columns.part.y * (sums[3] - sums[2])
        - columns.part.x * (sums[1] - sums[0]) + columns.pictures * sums[4];
}

// The mean of the rectangle round the pixel, texels taken as squares of one value: the difference
// of sums at its corners (Crow 1984), each of them bilinear between the corners of a texel.
// worker/images/summed_area.py says how sums are stored.
vec4 sample_summed_area(sampler2D table, Lookup at) {
    ivec2 counts = textureSize(table, 0);
    counts = ivec2(counts.x - 2, counts.y / 2 - 1);
    bvec2 repeats = greaterThan(at.period, vec2(0.0));
    vec2 framed = mix(vec2(1.0), vec2(0.0), repeats);
    vec2 reach = upright_reach(at);
    vec2 middle = at.place * at.size + framed;
    vec2 low = middle - 0.5 * reach, high = middle + 0.5 * reach;
    reach = high - low;  // as they are rounded
    Interval columns = interval(low.x, high.x, counts.x, repeats.x);
    Interval rows = interval(low.y, high.y, counts.y, repeats.y);
    vec4 sum = vec4(0.0);
    for (int part = 0; part < 2; part++) {  // rounded sums, and what rounding took away
        int first = part * (counts.y + 1);
        int start = first + rows.texel.x, end = first + rows.texel.y;
        sum += between(table, columns, start, end, counts.x)
            + rows.part.y * between(table, columns, end, end + 1, counts.x)
            - rows.part.x * between(table, columns, start, start + 1, counts.x)
            + rows.pictures * between(table, columns, first, first + counts.y, counts.x);
    }
    return texelFetch(table, ivec2(counts.x + 1, 0), 0) + sum / (reach.x * reach.y);
}
