#include "apps/common/picture/crc32.h"

#include <array>

namespace sward::apps {
namespace {

/// Tables of the CRC-32 of ISO 3309, for eight bytes at a time.
using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr CrcTables crcTables = [] {
    CrcTables tables{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t crc = i;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
        tables[0][i] = crc;
    }
    for (std::uint32_t i = 0; i < 256; ++i)
        for (std::size_t step = 1; step < tables.size(); ++step)
            tables[step][i] = (tables[step - 1][i] >> 8U) ^ tables[0][tables[step - 1][i] & 255U];
    return tables;
}();

} // namespace

std::uint32_t crc32Of(std::span<const std::byte> bytes)
{
    const auto at = [&](std::size_t i) { return std::to_integer<std::uint32_t>(bytes[i]); };
    std::uint32_t crc = ~0U;
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        const std::uint32_t low =
            crc ^ (at(i) | at(i + 1) << 8U | at(i + 2) << 16U | at(i + 3) << 24U);
        crc = crcTables[7][low & 255U] ^ crcTables[6][low >> 8U & 255U] ^
              crcTables[5][low >> 16U & 255U] ^ crcTables[4][low >> 24U] ^ crcTables[3][at(i + 4)] ^
              crcTables[2][at(i + 5)] ^ crcTables[1][at(i + 6)] ^ crcTables[0][at(i + 7)];
    }
    for (; i < bytes.size(); ++i)
        crc = (crc >> 8U) ^ crcTables[0][(crc ^ at(i)) & 255U];
    return ~crc;
}

} // namespace sward::apps
