#include "terrain/image/png_chunks.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace sward::terrain {
namespace {

constexpr std::size_t signatureBytes = 8;
constexpr std::size_t frameBytes = 12; // length, name and checksum of a chunk
constexpr std::array<std::string_view, 5> neededChunks{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};

std::uint32_t bigEndianAt(std::span<const std::byte> file, std::size_t at)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word = word << 8 | std::to_integer<std::uint32_t>(file[at + i]);
    return word;
}

} // namespace

std::vector<std::span<const std::byte>> pngChunks(std::span<const std::byte> file,
                                                  const std::string& place)
{
    std::vector<std::span<const std::byte>> parts{
        file.first(std::min(file.size(), signatureBytes))};
    std::size_t at = signatureBytes;
    while (true) {
        if (file.size() < at + frameBytes)
            fail(ErrorKind::input, "{}: truncated: the PNG ends at byte {}, before its chunk IEND",
                 place, file.size());
        const std::uint64_t length = bigEndianAt(file, at);
        const std::string_view name(reinterpret_cast<const char*>(file.data()) + at + 4, 4);
        const bool isName = std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
        });
        if (!isName)
            fail(ErrorKind::input, "{}: damaged: no chunk of a PNG begins at byte {}", place, at);
        if (length > file.size() - at - frameBytes)
            fail(ErrorKind::input,
                 "{}: truncated: its chunk {} at byte {} is {} bytes long, and {} follow", place,
                 name, at, length, file.size() - at - frameBytes);
        const std::size_t whole = static_cast<std::size_t>(length) + frameBytes;
        const bool isNeeded =
            std::find(neededChunks.begin(), neededChunks.end(), name) != neededChunks.end();
        if (isNeeded)
            parts.push_back(file.subspan(at, whole));
        else if (name[0] <= 'Z') // a capital: an image cannot be shown without it
            fail(ErrorKind::input, "{}: its chunk {} at byte {} belongs to no PNG that is read",
                 place, name, at);
        if (name == "IEND")
            return parts;
        at += whole;
    }
}

} // namespace sward::terrain
