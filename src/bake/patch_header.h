#pragma once

#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::bake {

/// Sets what a patch says of the blades of its whole subtree: bounds with the reach of every bent
/// blade, and the cone of their up-vectors.
void describeSubtree(shared::Patch& patch, const std::vector<shared::Blade>& blades,
                     std::span<const std::uint32_t> subtree);

/// Sets the steps by which the patch's own blades are quantised.
void describeOwn(shared::Patch& patch, const std::vector<shared::Blade>& blades,
                 std::span<const std::uint32_t> own);

} // namespace sward::bake
