#pragma once

#include "field/field.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace sward::field {

/// One of the fields to join, with its name for messages.
struct Member {
    FieldView view;   ///< verified
    std::string name; ///< of its file, for messages
};

/// Source of a patch of a joined field.
struct PatchSource {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t member = none; ///< index of the member; none: a node above the members' trees
    std::uint32_t patch = 0;     ///< index in that member
};

/// Several fields joined into one.
struct JoinedFields {
    Field field;                      ///< passes verify()
    std::vector<PatchSource> sources; ///< one per patch
};

/// Largest distance [m] of moved content from the first field's origin. At this distance the
/// rounding of a float is half a millimetre.
inline constexpr double farthestJoined = 16384.0;

/// Joins one or more `members` under one patch tree. Every patch keeps its blades, in order and
/// bit-identical except for the species' slot. Every blade keeps its key, so blades of two members
/// may share an id. Origin and defaults are the first member's; the first species' slots are those
/// of the first member with seeds, or else of the first. Species with equal name and look are
/// merged; cameras of all members are kept. Seeds are joined as joinSeeds() says. World places move
/// by at most half a millimetre, if origins differ. Provenance is {"fields": [one per member]};
/// keys are dropped unless all members have them. Throws Error{input} naming the member if there
/// are more than maxSpecies species, a member is beyond farthestJoined, 32 bits cannot count
/// patches, blades or corners, or its seeds cannot be joined.
JoinedFields join(std::span<const Member> members);

} // namespace sward::field
