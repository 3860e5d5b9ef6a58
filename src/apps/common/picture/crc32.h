#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sward::apps {

/// CRC-32 of ISO 3309, as PNG and ZIP files have it. `before`: of the bytes before these.
std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t before = 0);

} // namespace sward::apps
