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

// The sum over an interval of a row of sums. Near sums are subtracted first: what is left is small
// enough to keep its digits.
vec4 row_sum(sampler2D table, Interval columns, int row, int last) {
    vec4 start = texelFetch(table, ivec2(columns.texel.x, row), 0);
    vec4 end = texelFetch(table, ivec2(columns.texel.y, row), 0);
    vec4 after_start = texelFetch(table, ivec2(columns.texel.x + 1, row), 0);
    vec4 after_end = texelFetch(table, ivec2(columns.texel.y + 1, row), 0);
    vec4 whole = texelFetch(table, ivec2(last, row), 0);
    return (end - start) + columns.part.y * (after_end - end)
        - columns.part.x * (after_start - start) + columns.pictures * whole;
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
        vec4 start = row_sum(table, columns, first + rows.texel.x, counts.x);
        vec4 end = row_sum(table, columns, first + rows.texel.y, counts.x);
        vec4 after_start = row_sum(table, columns, first + rows.texel.x + 1, counts.x);
        vec4 after_end = row_sum(table, columns, first + rows.texel.y + 1, counts.x);
        vec4 whole = row_sum(table, columns, first + counts.y, counts.x);
        sum += (end - start) + rows.part.y * (after_end - end)
            - rows.part.x * (after_start - start) + rows.pictures * whole;
    }
    return texelFetch(table, ivec2(counts.x + 1, 0), 0) + sum / (reach.x * reach.y);
}
