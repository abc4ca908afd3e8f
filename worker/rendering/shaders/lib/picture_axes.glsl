#include "lib/reach.glsl"

// Right, up and forward of a picture taken towards an axis, as seen from within.
//   towards: 0 -z, 1 +z, 2 +x, 3 -x, 4 +y, 5 -y
vec3 in_picture(vec3 world, const int towards) {
    if (towards == 0) return vec3(world.x, world.y, -world.z);
    if (towards == 1) return vec3(-world.x, world.y, world.z);
    if (towards == 2) return vec3(world.z, world.y, world.x);
    if (towards == 3) return vec3(-world.z, world.y, -world.x);
    if (towards == 4) return vec3(world.x, world.z, world.y);
    return vec3(world.x, -world.z, -world.y);
}

Reach in_picture(Reach world, const int towards) {
    return Reach(
        in_picture(world.place, towards),
        in_picture(world.across_x, towards),
        in_picture(world.across_y, towards)
    );
}
