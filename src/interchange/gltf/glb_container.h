#pragma once

#include "core/files/atomic_file.h"

#include <cstdint>
#include <string_view>

namespace sward::interchange {

/// Bytes of a .glb besides its two chunks: its header and theirs.
inline constexpr std::uint64_t glbHeaderBytes = 12 + 2 * 8;

/// Largest .glb: its length has 32 bits.
inline constexpr std::uint64_t largestGlb = 0xffffffffU;

/// Writes the header, the chunk with `json` (a multiple of four bytes) and the header of the binary
/// chunk, whose `binaryBytes` follow. All together must be at most largestGlb.
void writeGlbHeader(AtomicFile& file, std::string_view json, std::uint64_t binaryBytes);

} // namespace sward::interchange
