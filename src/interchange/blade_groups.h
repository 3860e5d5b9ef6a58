#pragma once

#include "field/field.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::interchange {

/// Neighbouring blades that become one node of an export. Formats without a patch tree cull by such
/// nodes.
struct BladeGroup {
    std::vector<std::uint32_t> patches; ///< in the order of the field: coarse before fine
    std::uint64_t bladeCount = 0;
    Aabb bounds;           ///< of every bent blade [m], relative to the field's origin
    glm::dvec3 place{0.0}; ///< the node's place [m] relative to the origin: in the middle of
                           ///< `bounds`, on a whole metre
};

/// Most blades of one group. Ten million blades need a few hundred draws, and a group is small
/// enough to be culled.
inline constexpr std::uint64_t largestGroup = 32768;

/// Divides the field's blades into groups. Each subtree of at most `largest` blades is one group.
/// The representatives above such subtrees are grouped per cell of at most 32 m, together with
/// subtrees too small for a group. Every patch with blades is in exactly one group. No group has
/// more than max(largest, maxPatchBlades) blades. A place on a whole metre is exact in single
/// precision up to 1.6e7 m, and so is its sum with the origin (a multiple of 32 m). So rounding
/// never shifts groups against each other.
std::vector<BladeGroup> groupBlades(const field::FieldView& field,
                                    std::uint64_t largest = largestGroup);

} // namespace sward::interchange
