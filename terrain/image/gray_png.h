#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::terrain {

/// A gray image of 8 bits as the bytes of a PNG file. `values`: width·height, rows from the top.
/// Throws Error{runtime} if it cannot be encoded.
std::vector<std::byte> grayPng(std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> values);

} // namespace sward::terrain
