#pragma once

#include <cstdint>
#include <vector>

namespace sward::field {

/// The numbers of clumps, 0 to 254, from the dark to the light ones: by shared::clumpTone().
std::vector<std::uint8_t> clumpsByTone();

/// The place of each number in that order.
std::vector<std::uint8_t> placesByTone();

/// Both as shared::SowTones.
std::vector<std::uint32_t> toneWords();

} // namespace sward::field
