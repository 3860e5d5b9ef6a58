#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// The parts of a PNG file that its pixels need: signature, IHDR, PLTE, tRNS, IDAT and IEND, each
/// with length and checksum. Text, profiles and the like are left out, so that none is unpacked.
/// Throws Error{input} naming `place` if a chunk goes beyond the file's end or IEND is missing
/// (both "truncated"), or if another chunk must be understood.
std::vector<std::span<const std::byte>> pngChunks(std::span<const std::byte> file,
                                                  const std::string& place);

} // namespace sward::terrain
