#pragma once

#include "fuzz/entries.h"

#include <cstddef>

namespace sward::fuzz {

/// Counts the memory that operator new has given out since it was made; that of libraries in C is
/// not counted. One at a time.
class MemoryPeak {
public:
    MemoryPeak();

    /// The most that was held at one time, beyond what was held before [bytes].
    std::size_t bytes() const;
};

/// The most memory that reading `size` bytes may take: 64 bytes for each, and 64 MB.
constexpr std::size_t memoryLimit(std::size_t size)
{
    return 64 * size + (std::size_t(64) << 20);
}

} // namespace sward::fuzz
