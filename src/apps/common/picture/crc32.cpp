#include "apps/common/picture/crc32.h"

#include <array>
#include <bit>
#include <cstring>

namespace sward::apps {
namespace {

constexpr std::size_t crcStep = 16; ///< [bytes] at a time

/// Tables of the CRC-32 of ISO 3309, for the bytes of a crcStep.
using CrcTables = std::array<std::array<std::uint32_t, 256>, crcStep>;

constexpr CrcTables crcTables = [] {
    CrcTables tables{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t crc = i;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
        tables[0][i] = crc;
    }
    for (std::uint32_t i = 0; i < 256; ++i)
        for (std::size_t k = 1; k < tables.size(); ++k)
            tables[k][i] = (tables[k - 1][i] >> 8U) ^ tables[0][tables[k - 1][i] & 255U];
    return tables;
}();

} // namespace

std::uint32_t crc32Of(std::span<const std::byte> bytes, std::uint32_t before)
{
    const auto wordAt = [&](std::size_t i) {
        std::array<std::uint32_t, 2> words{};
        std::memcpy(words.data(), bytes.data() + i, sizeof words);
        return words;
    };
    static_assert(std::endian::native == std::endian::little);
    std::uint32_t crc = ~before;
    std::size_t i = 0;
    for (; i + crcStep <= bytes.size(); i += crcStep) {
        auto [a, b] = wordAt(i);
        const auto [c, d] = wordAt(i + 8);
        a ^= crc;
        crc = 0;
        std::size_t table = crcStep;
        for (const std::uint32_t word : {a, b, c, d})
            for (std::uint32_t shift = 0; shift < 32; shift += 8)
                crc ^= crcTables[--table][word >> shift & 255U];
    }
    for (; i < bytes.size(); ++i)
        crc = (crc >> 8U) ^ crcTables[0][(crc ^ std::to_integer<std::uint32_t>(bytes[i])) & 255U];
    return ~crc;
}

} // namespace sward::apps
