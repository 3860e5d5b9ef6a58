#pragma once

#include <cstdint>

namespace sward {

/// Largest resident size of the program so far [bytes].
std::uint64_t peakMemory();

} // namespace sward
