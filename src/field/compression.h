#pragma once

#include "core/uninitialized.h"

#include <cstddef>
#include <span>
#include <string>

namespace sward::field {

/// Array elements as one zstd frame; the same bytes for the same input. Byte k of all elements
/// comes side by side (all first bytes, then all second …): neighbours in a field have similar high
/// bytes, which then compress. `raw` is a whole number of elements.
UninitializedVector<std::byte> compress(std::span<const std::byte> raw, std::size_t elementBytes);

/// Throws Error{input} naming `place` unless the frame says that it holds `rawBytes`: asked before
/// memory is taken for them.
void checkClaim(std::span<const std::byte> stored, std::size_t rawBytes, const std::string& place);

/// Undoes compress() into `raw`. Throws Error{input} naming `place` unless the frame holds exactly
/// as many bytes.
void decompress(std::span<const std::byte> stored, std::size_t elementBytes,
                std::span<std::byte> raw, const std::string& place);

} // namespace sward::field
