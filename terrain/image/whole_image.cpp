#include "terrain/image/whole_image.h"

#include "core/error.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace sward::terrain {
namespace {

using Bytes = std::span<const std::byte>;

std::string_view textOf(Bytes file, std::size_t at, std::size_t size)
{
    return std::string_view(reinterpret_cast<const char*>(file.data()), file.size())
        .substr(std::min(at, file.size()), size);
}

std::uint32_t byteAt(Bytes file, std::size_t at)
{
    return at < file.size() ? std::to_integer<std::uint32_t>(file[at]) : 0U;
}

std::uint32_t littleAt(Bytes file, std::size_t at, std::size_t bytes)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < bytes; ++i)
        word |= byteAt(file, at + i) << (8 * i);
    return word;
}

std::uint32_t bigAt(Bytes file, std::size_t at)
{
    return byteAt(file, at) << 8 | byteAt(file, at + 1);
}

[[noreturn]] void failTruncated(const std::string& place)
{
    fail(ErrorKind::input, "{}: the image is truncated: it ends before its last pixel", place);
}

[[noreturn]] void failIndex(const std::string& place, std::uint64_t pixel, std::uint64_t width,
                            std::uint64_t index, std::uint64_t colors)
{
    // Rows as the file stores them may begin at the bottom: say only which pixel it is.
    fail(ErrorKind::input, "{}: pixel {} of stored row {} has colour {} of a palette of {}", place,
         pixel % width, pixel / width, index, colors);
}

// JPEG -------------------------------------------------------------------------------------------

// Number of 8 × 8 blocks that the frame header with the marker at `at` declares: all are coded.
std::uint64_t blocksOf(Bytes file, std::size_t at)
{
    const std::uint64_t height = bigAt(file, at + 5);
    const std::uint64_t width = bigAt(file, at + 7);
    const std::size_t components = byteAt(file, at + 9);
    std::uint64_t most[2] = {1, 1};
    const auto sampling = [&](std::size_t component, std::size_t axis) {
        const std::uint32_t both = byteAt(file, at + 11 + 3 * component);
        return std::uint64_t(std::max(axis == 0 ? both >> 4 : both & 15U, 1U));
    };
    for (std::size_t c = 0; c < components; ++c)
        for (std::size_t axis = 0; axis < 2; ++axis)
            most[axis] = std::max(most[axis], sampling(c, axis));
    std::uint64_t blocks = 0;
    for (std::size_t c = 0; c < components; ++c)
        blocks += ((width * sampling(c, 0) + 8 * most[0] - 1) / (8 * most[0])) *
                  ((height * sampling(c, 1) + 8 * most[1] - 1) / (8 * most[1]));
    return blocks;
}

// Walks through the segments to the end marker and sums the bytes of coded pixels. A block takes at
// least one bit, or two in a baseline image.
void requireWholeJpeg(Bytes file, const std::string& place)
{
    std::uint64_t blocks = 0;
    std::uint64_t bitsOfBlock = 2;
    std::uint64_t coded = 0;
    std::size_t at = 2;
    while (true) {
        while (at < file.size() && file[at] != std::byte(0xff))
            ++at;
        while (at < file.size() && file[at] == std::byte(0xff))
            ++at;
        if (at >= file.size())
            failTruncated(place);
        const std::uint32_t marker = byteAt(file, at++);
        if (marker == 0xd9)
            break;
        if (marker == 0x00 || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8))
            continue; // stands alone
        if (marker >= 0xc0 && marker <= 0xc2) {
            blocks = std::max(blocks, blocksOf(file, at - 2));
            bitsOfBlock = marker == 0xc2 ? 1 : 2;
        }
        at += std::max(bigAt(file, at), 2U);
        if (at > file.size())
            failTruncated(place);
        if (marker != 0xda)
            continue;
        // Coded pixels go up to a marker that is neither a stuffed zero nor a restart.
        const std::size_t begin = at;
        while (at + 1 < file.size() &&
               !(file[at] == std::byte(0xff) && byteAt(file, at + 1) != 0 &&
                 byteAt(file, at + 1) != 0xff && (byteAt(file, at + 1) & 0xf8U) != 0xd0))
            ++at;
        coded += at - begin;
    }
    if (coded * 8 < blocks * bitsOfBlock)
        failTruncated(place);
}

// BMP --------------------------------------------------------------------------------------------

void requireWholeBmp(Bytes file, const std::string& place)
{
    const std::uint64_t first = littleAt(file, 10, 4);
    const std::uint32_t header = littleAt(file, 14, 4);
    const bool isOld = header == 12;
    const std::uint64_t width = isOld ? littleAt(file, 18, 2) : littleAt(file, 18, 4);
    const auto signedHeight = static_cast<std::int32_t>(littleAt(file, 22, 4));
    const std::uint64_t height = isOld ? littleAt(file, 20, 2)
                                       : static_cast<std::uint64_t>(std::abs(
                                             static_cast<std::int64_t>(signedHeight)));
    const std::uint64_t bits = isOld ? littleAt(file, 24, 2) : littleAt(file, 28, 2);
    if (width == 0 || height == 0)
        return;
    const std::uint64_t used = (width * bits + 7) / 8; // of a row, without filling
    const std::uint64_t stride = (used + 3) / 4 * 4;
    if (first > file.size() || (height - 1) * stride + used > file.size() - first)
        failTruncated(place);
    if (bits > 8 || bits == 0)
        return;
    const std::uint64_t start = 14 + std::uint64_t(header);
    if (first < start)
        return;
    const std::uint64_t colors =
        std::min<std::uint64_t>((first - start) / (isOld ? 3 : 4), 256);
    const std::uint32_t mask = (1U << bits) - 1U;
    for (std::uint64_t y = 0; y < height; ++y)
        for (std::uint64_t x = 0; x < width; ++x) {
            const std::uint32_t byte = byteAt(file, first + y * stride + x * bits / 8);
            const std::uint32_t index = byte >> (8 - bits - x * bits % 8) & mask;
            if (index >= colors)
                failIndex(place, y * width + x, width, index, colors);
        }
}

// TGA --------------------------------------------------------------------------------------------

void requireWholeTga(Bytes file, const std::string& place)
{
    const std::uint32_t type = byteAt(file, 2);
    const bool isPacked = type >= 9;
    const bool hasPalette = (type & 7U) == 1;
    const std::uint64_t colors = littleAt(file, 5, 2);
    const std::uint64_t width = littleAt(file, 12, 2);
    const std::uint64_t pixels = width * littleAt(file, 14, 2);
    const std::size_t bytes = (byteAt(file, 16) + 7) / 8;
    std::size_t at = 18 + byteAt(file, 0);
    // stb_image skips bytes where the format has entries.
    if (hasPalette)
        at += littleAt(file, 3, 2) + colors * ((byteAt(file, 7) + 7) / 8);
    const auto requireColor = [&](std::size_t offset, std::uint64_t pixel) {
        const std::uint32_t index = littleAt(file, offset, bytes);
        if (hasPalette && index >= colors)
            failIndex(place, pixel, width, index, colors);
    };
    if (!isPacked) {
        if (at > file.size() || pixels * bytes > file.size() - at)
            failTruncated(place);
        for (std::uint64_t i = 0; i < pixels && hasPalette; ++i)
            requireColor(at + i * bytes, i);
        return;
    }
    for (std::uint64_t pixel = 0; pixel < pixels;) {
        if (at >= file.size())
            failTruncated(place);
        const std::uint32_t packet = byteAt(file, at++);
        const std::uint64_t count = (packet & 127U) + 1;
        const std::uint64_t stored = (packet & 128U) != 0 ? 1 : std::min(count, pixels - pixel);
        if (stored * bytes > file.size() - at)
            failTruncated(place);
        for (std::uint64_t i = 0; i < stored; ++i)
            requireColor(at + i * bytes, pixel + i);
        at += stored * bytes;
        pixel += count;
    }
}

// As stb_image tells a TGA, which has no signature.
bool isTga(Bytes file)
{
    const std::uint32_t type = byteAt(file, 2);
    const std::uint32_t hasMap = byteAt(file, 1);
    if (hasMap > 1 || (hasMap == 1 ? type != 1 && type != 9
                                   : type != 2 && type != 3 && type != 10 && type != 11))
        return false;
    const std::uint32_t depth = byteAt(file, 16);
    return depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
}

} // namespace

bool isJpeg(Bytes file)
{
    return textOf(file, 0, 2) == "\xff\xd8";
}

void requireWholeImage(Bytes file, const std::string& place)
{
    if (isJpeg(file))
        requireWholeJpeg(file, place);
    else if (textOf(file, 0, 2) == "BM")
        requireWholeBmp(file, place);
    else if (isTga(file))
        requireWholeTga(file, place);
}

const char* foreignImage(Bytes file)
{
    struct Start {
        std::string_view bytes;
        const char* name;
    };
    static constexpr Start starts[] = {
        {"\xabKTX 20", "KTX2"}, {"DDS ", "DDS"}, {"GIF8", "GIF"},
        {"8BPS", "PSD"},        {"#?", "HDR"},   {"P5", "PNM"},
        {"P6", "PNM"},          {"\x53\x80\xf6\x34", "PIC"}};
    if (textOf(file, 0, 4) == "RIFF" && textOf(file, 8, 4) == "WEBP")
        return "WebP";
    for (const Start& one : starts)
        if (textOf(file, 0, one.bytes.size()) == one.bytes)
            return one.name;
    return "";
}

} // namespace sward::terrain
