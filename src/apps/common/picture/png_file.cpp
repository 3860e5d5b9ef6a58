#include "apps/common/picture/png_file.h"

#include "apps/common/picture/crc32.h"
#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"

#include <stb/stb_image_write.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

// The compressor of the library's PNG writer; its header declares it only where it is compiled.
extern "C" unsigned char* stbi_zlib_compress(unsigned char* data, int bytes, int* compressed,
                                             int quality);

namespace sward::apps {
namespace {

constexpr int channels = 3;

void append(void* target, void* bytes, int size)
{
    auto& encoded = *static_cast<std::vector<std::byte>*>(target);
    const auto* first = static_cast<const std::byte*>(bytes);
    encoded.insert(encoded.end(), first, first + size);
}

constexpr int zlibQuality = 8; ///< the library's own

/// Appends a number, its highest byte first.
void appendNumber(std::vector<std::byte>& bytes, std::uint32_t number)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<std::byte>(number >> shift & 255U));
}

void appendChunk(std::vector<std::byte>& bytes, std::string_view type,
                 std::span<const std::byte> content)
{
    appendNumber(bytes, static_cast<std::uint32_t>(content.size()));
    const std::size_t first = bytes.size();
    for (const char c : type)
        bytes.push_back(static_cast<std::byte>(c));
    bytes.insert(bytes.end(), content.begin(), content.end());
    appendNumber(bytes, crc32Of(std::span(bytes).subspan(first)));
}

/// The rows of a picture as PNG compresses them: each value less the one to its left.
std::vector<unsigned char> filteredRows(glm::uvec2 size, std::uint32_t each,
                                        std::span<const std::uint16_t> values)
{
    std::vector<unsigned char> rows;
    const std::size_t width = std::size_t(size.x) * each;
    rows.reserve((2 * width + 1) * size.y);
    for (std::size_t y = 0; y < size.y; ++y) {
        rows.push_back(1); // the filter "Sub", of bytes
        for (std::size_t i = 0; i < width; ++i) {
            const std::uint32_t value = values[y * width + i];
            const std::uint32_t left = i >= each ? values[y * width + i - each] : 0U;
            rows.push_back(static_cast<unsigned char>((value >> 8U) - (left >> 8U)));
            rows.push_back(static_cast<unsigned char>(value - left));
        }
    }
    return rows;
}

} // namespace

void writePng16(glm::uvec2 size, std::uint32_t each, std::span<const std::uint16_t> values,
                const std::filesystem::path& path, bool overwrite)
{
    expect((each == 1 || each == 3 || each == 4) && size.x > 0 && size.y > 0 &&
               values.size() == each * std::size_t(size.x) * size.y,
           "a picture has one, three or four values a pixel");
    std::vector<unsigned char> rows = filteredRows(size, each, values);
    int count = 0;
    unsigned char* const packed =
        rows.size() > std::size_t(std::numeric_limits<int>::max())
            ? nullptr
            : stbi_zlib_compress(rows.data(), static_cast<int>(rows.size()), &count, zlibQuality);
    if (packed == nullptr)
        fail(ErrorKind::runtime, "{}: cannot encode a picture of {}x{} pixels", path.string(),
             size.x, size.y);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owned(packed, &std::free);

    std::vector<std::byte> header;
    appendNumber(header, size.x);
    appendNumber(header, size.y);
    constexpr std::array<unsigned, 5> kinds{0, 0, 0, 2, 6}; // grey, RGB, RGBA by their channels
    for (const unsigned byte : {16U, kinds[each], 0U, 0U, 0U})
        header.push_back(static_cast<std::byte>(byte));
    std::vector<std::byte> encoded;
    for (const unsigned byte : {0x89U, 0x50U, 0x4eU, 0x47U, 0x0dU, 0x0aU, 0x1aU, 0x0aU})
        encoded.push_back(static_cast<std::byte>(byte));
    appendChunk(encoded, "IHDR", header);
    appendChunk(encoded, "IDAT", std::as_bytes(std::span(packed, static_cast<std::size_t>(count))));
    appendChunk(encoded, "IEND", {});
    AtomicFile file(path, overwrite);
    file.write(encoded);
    file.commit();
}

void writePng(glm::uvec2 size, std::span<const std::uint8_t> rgb, const std::filesystem::path& path,
              bool overwrite)
{
    expect(size.x > 0 && size.y > 0 && rgb.size() == channels * std::size_t(size.x) * size.y,
           "a picture has three bytes a pixel");

    // Encode in memory, so that the file appears whole or not at all.
    std::vector<std::byte> encoded;
    const int width = static_cast<int>(size.x);
    const int height = static_cast<int>(size.y);
    if (stbi_write_png_to_func(append, &encoded, width, height, channels, rgb.data(),
                               channels * width) == 0)
        fail(ErrorKind::runtime, "{}: cannot encode a picture of {}x{} pixels", path.string(),
             width, height);
    AtomicFile file(path, overwrite);
    file.write(encoded);
    file.commit();
}

} // namespace sward::apps
