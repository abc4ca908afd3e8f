#include "lib/level_of_detail.glsl"
#include "lib/relief.glsl"
uniform float parallax_depth;
uniform int parallax_channel;
uniform int parallax_steps;

const float GRAZING = 0.05;  // cosine below which a ray counts as no flatter

// How far the ray goes aside until it has reached the depth, in steps to the next pixels: d v_t / v_n
// on the surface, against the view. Seen from inside there is nothing to look into.
vec2 parallax_reach(SurfacePoint point, vec3 normal) {
    Patch surface = patch_at(point, normal);
    vec3 view = normalize(inverse(mat3(eye_from_object)) * point.view);
    float facing = dot(view, surface.normal);
    vec3 aside = -laid(view, surface.normal) * (parallax_depth / max(facing, GRAZING));
    vec2 pixels = vec2(
        dot(cross(aside, surface.across_y), surface.normal),
        dot(cross(surface.across_x, aside), surface.normal)
    ) / surface.area;
    bool usable = facing > 0.0 && all(lessThan(abs(pixels), vec2(1e9)));
    return usable ? pixels : vec2(0.0);
}

Footprint moved(Footprint at, vec2 pixels) {
    return Footprint(at.place + pixels.x * at.across_x + pixels.y * at.across_y, at.across_x, at.across_y);
}

// How deep the relief lies, from 0 to 1 of the whole depth; what is no number is 0 deep.
float relief_depth(sampler2D picture, vec2 place, float level) {
    float held = textureLod(picture, place, level)[parallax_channel];
    return isnan(held) ? 0.0 : clamp(1.0 - held, 0.0, 1.0);
}

// Pixels between here and where the eye sees the relief (Kaneko et al. 2001: one shift by the depth
// found here; Brawley and Tatarchuk 2004: where the ray, in steps, first lies below the relief, and
// between the last two steps where it meets the line through them).
vec2 parallax_offset(sampler2D picture, Footprint at, mat3 transform, vec4 period, vec2 size, vec2 reach) {
    Lookup here = look_up(at, transform, period, size);
    return reach * relief_depth(picture, here.place, level_of_detail(here));
}

vec2 parallax_occlusion(sampler2D picture, Footprint at, mat3 transform, vec4 period, vec2 size, vec2 reach) {
    Lookup here = look_up(at, transform, period, size);
    float level = level_of_detail(here);
    vec2 aside = (here.across_x * reach.x + here.across_y * reach.y) / size;
    float before = relief_depth(picture, here.place, level);
    float ray = 0.0;
    float hit = before <= 0.0 ? 0.0 : 1.0;
    for (int i = 1; i <= parallax_steps && hit == 1.0; i++) {
        float next = float(i) / float(parallax_steps);
        float above = relief_depth(picture, here.place + next * aside, level) - next;
        if (above <= 0.0) hit = ray + (next - ray) * before / (before - above);
        before = above;
        ray = next;
    }
    return reach * hit;
}
