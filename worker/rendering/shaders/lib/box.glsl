// The box that holds the mesh, in the mesh's own frame.
uniform vec3 box_low;
uniform vec3 box_high;

// Where a ray enters and leaves it, in steps of `way` from a place; nowhere if the first is more.
vec2 through_box(vec3 place, vec3 way) {
    // A ray along two sides never meets the others
    vec3 safe = mix(way, vec3(1e-20), lessThan(abs(way), vec3(1e-20)));
    vec3 low = (box_low - place) / safe, high = (box_high - place) / safe;
    vec3 first = min(low, high), last = max(low, high);
    return vec2(max(first.x, max(first.y, first.z)), min(last.x, min(last.y, last.z)));
}
