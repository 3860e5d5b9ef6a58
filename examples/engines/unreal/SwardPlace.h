// A blade of Sward in the axes of Unreal: left-handed, Z up, centimetres. Knows nothing of Unreal.
#pragma once

#define SWARD_NO_VULKAN
#include <sward/c/sward.h>

namespace sward_unreal {

struct Place {
    double position[3]; // [cm] relative to the field's origin
    float rotation[4];  // quaternion x, y, z, w
    float scale[3];     // of a mesh 1 cm long along x and z, whose blade stands along +Z and leans to +Y
};

// Unreal's y is Sward's z, and its z Sward's y. The exchange mirrors: axes of rotations change their sign.
inline Place placeOf(const sward_field_info& info, const sward_blade& blade)
{
    float turn[4];
    sward_blade_rotation(&blade, turn);
    return {{100.0 * (blade.root[0] - info.origin[0]), 100.0 * (blade.root[2] - info.origin[2]),
             100.0 * (blade.root[1] - info.origin[1])},
            {-turn[0], -turn[2], -turn[1], turn[3]},
            {100.0f * blade.width, 100.0f * blade.height, 100.0f * blade.height}};
}

} // namespace sward_unreal
