#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sward::field {

/// One zstd frame; the same bytes for the same input.
std::vector<std::byte> compress(std::span<const std::byte> raw);

/// Undoes compress(). Throws Error{input} naming `place` unless the result has exactly `rawBytes`
/// bytes.
std::vector<std::byte> decompress(std::span<const std::byte> stored, std::size_t rawBytes,
                                  const std::string& place);

/// Puts byte k of all elements side by side (all first bytes, then all second …): neighbours in a
/// field have similar high bytes, which then compress.
std::vector<std::byte> shuffleBytes(std::span<const std::byte> raw, std::size_t elementBytes);
std::vector<std::byte> unshuffleBytes(std::span<const std::byte> shuffled,
                                      std::size_t elementBytes);

} // namespace sward::field
