#include "support/pictures/picture.h"

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace sward::golden {
namespace {

constexpr int channels = 3;
constexpr int amplification = 16;

void requireSameSize(const Picture& a, const Picture& b)
{
    if (a.width != b.width || a.height != b.height)
        throw std::runtime_error("the pictures have different sizes");
}

int channelDifference(const Picture& a, const Picture& b, std::size_t index)
{
    return std::abs(int(a.rgb[index]) - int(b.rgb[index]));
}

} // namespace

Picture readPicture(const std::filesystem::path& path)
{
    int width = 0;
    int height = 0;
    int found = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load(path.c_str(), &width, &height, &found, channels), stbi_image_free);
    if (!pixels)
        throw std::runtime_error(path.string() + ": " + stbi_failure_reason());
    Picture picture{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
    picture.rgb.assign(pixels.get(), pixels.get() + channels * picture.width * picture.height);
    return picture;
}

void writePicture(const Picture& picture, const std::filesystem::path& path)
{
    const int width = static_cast<int>(picture.width);
    const int height = static_cast<int>(picture.height);
    if (stbi_write_png(path.c_str(), width, height, channels, picture.rgb.data(),
                       channels * width) == 0)
        throw std::runtime_error(path.string() + ": cannot be written");
}

Difference compare(const Picture& expected, const Picture& actual)
{
    requireSameSize(expected, actual);
    Difference difference;
    difference.pixels = expected.width * expected.height;
    for (std::size_t pixel = 0; pixel < difference.pixels; ++pixel) {
        int largest = 0;
        for (std::size_t channel = 0; channel < channels; ++channel)
            largest =
                std::max(largest, channelDifference(expected, actual, channels * pixel + channel));
        difference.largest = std::max(difference.largest, largest);
        if (largest > tolerance)
            ++difference.differentPixels;
    }
    return difference;
}

Picture amplifiedDifference(const Picture& expected, const Picture& actual)
{
    requireSameSize(expected, actual);
    Picture result = expected;
    for (std::size_t i = 0; i < result.rgb.size(); ++i)
        result.rgb[i] = static_cast<std::uint8_t>(
            std::min(255, amplification * channelDifference(expected, actual, i)));
    return result;
}

} // namespace sward::golden
