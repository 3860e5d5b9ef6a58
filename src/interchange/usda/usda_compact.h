#pragma once

#include "interchange/blade_groups.h"
#include "interchange/instances.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

namespace sward::interchange {

/// Step of positions in a group of a compact layer whose roots span `extent` [m]: 1/256 m up to 8
/// m, and 1/128 m in wider ones, whose positions would else have more digits. Half of it is the
/// largest error along an axis.
constexpr double usdaPlaceStep(double extent)
{
    return extent <= 8.0 ? 1.0 / 256.0 : 1.0 / 128.0;
}

/// Steps up to the largest scale of a species in a group.
inline constexpr int usdaScaleSteps = 99;

/// A quaternion in hundredths, w x y z: of the sixteen around the exact one that which turns and
/// stretches the least. It turns by at most 1.3°. Its length is within 0.5 % of 1; for a reader
/// that does not normalise it, that changes sizes by up to 2 %.
std::array<int, 4> hundredthsOf(const glm::quat& rotation);

/// Appends the PointInstancer /Field/group_`index` with few digits: positions and scales are
/// integers, which the instancer and its prototypes scale to metres; primvars have indices. With
/// `withIds` also ids and clumps. `prototypes`: names below /Field/Blades, one per species.
void appendCompactGroup(fmt::memory_buffer& text, const BladeGroup& group, std::size_t index,
                        const std::vector<std::string>& prototypes,
                        const std::vector<Instance>& instances, bool withIds);

} // namespace sward::interchange
