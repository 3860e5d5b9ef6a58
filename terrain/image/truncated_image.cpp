#include "terrain/image/truncated_image.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace sward::terrain {
namespace {

// A file that notices reads behind its end.
struct ReadFile {
    std::span<const std::byte> bytes;
    std::size_t at = 0;
    bool isOverrun = false;
};

int readSome(void* user, char* to, int size)
{
    auto& file = *static_cast<ReadFile*>(user);
    const std::size_t left = file.bytes.size() - file.at;
    const std::size_t taken = std::min(left, static_cast<std::size_t>(std::max(size, 0)));
    // stb fills a buffer ahead of its need: only a read that gets nothing was in want.
    if (taken == 0 && size > 0)
        file.isOverrun = true;
    if (taken > 0)
        std::memcpy(to, file.bytes.data() + file.at, taken);
    file.at += taken;
    return static_cast<int>(taken);
}

void skipSome(void* user, int size)
{
    auto& file = *static_cast<ReadFile*>(user);
    if (size < 0) {
        file.at -= std::min(file.at, static_cast<std::size_t>(-static_cast<long>(size)));
        return;
    }
    const std::size_t left = file.bytes.size() - file.at;
    if (static_cast<std::size_t>(size) > left)
        file.isOverrun = true;
    file.at += std::min(left, static_cast<std::size_t>(size));
}

int isAtEnd(void* user)
{
    const auto& file = *static_cast<const ReadFile*>(user);
    return file.at >= file.bytes.size() ? 1 : 0;
}

bool startsWith(std::span<const std::byte> file, std::string_view start)
{
    return file.size() >= start.size() && std::memcmp(file.data(), start.data(), start.size()) == 0;
}

bool hasJpegEnd(std::span<const std::byte> file)
{
    for (std::size_t i = file.size(); i >= 2; --i)
        if (file[i - 2] == std::byte(0xff) && file[i - 1] == std::byte(0xd9))
            return true;
    return false;
}

} // namespace

bool isTruncatedImage(std::span<const std::byte> file)
{
    if (startsWith(file, "\xff\xd8"))
        return !hasJpegEnd(file);
    if (startsWith(file, "\x89PNG"))
        return false;
    ReadFile read{file};
    const stbi_io_callbacks callbacks{readSome, skipSome, isAtEnd};
    int width = 0;
    int height = 0;
    int channels = 0;
    unsigned char* const pixels =
        stbi_load_from_callbacks(&callbacks, &read, &width, &height, &channels, 0);
    const bool isImage = pixels != nullptr;
    stbi_image_free(pixels);
    return isImage && read.isOverrun;
}

} // namespace sward::terrain
