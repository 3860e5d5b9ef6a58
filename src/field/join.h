#pragma once

#include "field/field.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace sward::field {

/// A field among several that are joined, and its name for messages.
struct Member {
    FieldView view;   ///< verified
    std::string name; ///< a file's, for people
};

/// Where a patch of a joined field comes from.
struct PatchSource {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t member = none; ///< place among the members; none: a node above theirs
    std::uint32_t patch = 0;     ///< of that member
};

/// Several fields as one, which is drawn like any other.
struct JoinedFields {
    Field field;                      ///< passes verify()
    std::vector<PatchSource> sources; ///< of each of its patches
};

/// Farther than this from the first field's origin nothing that is moved may lie [m]: there a float
/// keeps half a millimetre.
inline constexpr double farthestJoined = 16384.0;

/// Joins `members` (one or more) under one tree of patches. Every patch keeps its blades, in their
/// order and bit by bit but for the species' slot, and every blade its key: ids are those of its
/// own field, so that blades of two members may have the same. Origin, defaults and the order of
/// the species' slots begin with the first member's; species that are alike in name and look become
/// one, and cameras of all are kept. World places stay as they are, to half a millimetre where the
/// origins differ. Provenance is {"fields": [each one's]}; keys are left out unless all have them.
/// Throws Error{input} naming the member if there are more than maxSpecies species together, if one
/// lies farther than farthestJoined, or if 32 bits do not count the patches, blades or corners.
JoinedFields join(std::span<const Member> members);

} // namespace sward::field
