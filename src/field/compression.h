#pragma once

#include "core/uninitialized.h"

#include <cstddef>
#include <span>
#include <string>

namespace sward::field {

/// Compresses array elements into one zstd frame; the result depends on the input alone. Byte k of
/// all elements is stored together (all first bytes, then all second …). Neighbours in a field have
/// similar high bytes, which then compress. `raw` is a whole number of elements.
UninitializedVector<std::byte> compress(std::span<const std::byte> raw, std::size_t elementBytes);

/// Throws Error{input} naming `place` unless the frame declares `rawBytes`. Called before memory is
/// allocated for them.
void checkClaim(std::span<const std::byte> stored, std::size_t rawBytes, const std::string& place);

/// Undoes compress() into `raw`. Throws Error{input} naming `place` unless the frame holds exactly
/// `raw.size()` bytes.
void decompress(std::span<const std::byte> stored, std::size_t elementBytes,
                std::span<std::byte> raw, const std::string& place);

} // namespace sward::field
