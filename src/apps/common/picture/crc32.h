#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sward::apps {

/// CRC-32 of ISO 3309, as PNG and ZIP files have it.
std::uint32_t crc32Of(std::span<const std::byte> bytes);

} // namespace sward::apps
