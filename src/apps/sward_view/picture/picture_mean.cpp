#include "apps/sward_view/picture/picture_mean.h"

#include "core/expect.h"
#include "core/math/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::view {
namespace {

constexpr std::size_t channelsOfMean = 4;

std::array<float, 256> linearTable()
{
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = linearOf(static_cast<float>(i) / 255.0f);
    return table;
}

// Radical inverse: the digits of `index` in `base`, mirrored at the point.
float radicalInverse(std::uint32_t index, std::uint32_t base)
{
    double value = 0.0;
    double digit = 1.0 / base;
    for (; index > 0; index /= base, digit /= base)
        value += digit * (index % base);
    return static_cast<float>(value);
}

} // namespace

glm::vec2 subpixelOffset(std::uint32_t index)
{
    return {radicalInverse(index + 1, 2) - 0.5f, radicalInverse(index + 1, 3) - 0.5f};
}

PictureMean::PictureMean(glm::uvec2 size)
    : size_(size)
    , sums_(channelsOfMean * size.x * size.y)
{
}

std::size_t PictureMean::placeOf(glm::uvec2 pixel) const
{
    return channelsOfMean * (std::size_t(pixel.y) * size_.x + pixel.x);
}

void PictureMean::add(const Picture& picture, glm::uvec2 first)
{
    static const std::array<float, 256> linear = linearTable();
    expect(first.x + picture.size.x <= size_.x && first.y + picture.size.y <= size_.y,
           "the part lies in the picture");
    const std::size_t row = channelsOfMean * picture.size.x;
    for (std::uint32_t y = 0; y < picture.size.y; ++y) {
        const std::uint8_t* from = &picture.rgba[y * row];
        float* to = &sums_[placeOf({first.x, first.y + y})];
        for (std::size_t i = 0; i < row; ++i)
            to[i] += linear[from[i]];
    }
}

Picture PictureMean::mean(std::uint32_t count, glm::uvec2 first, glm::uvec2 size) const
{
    expect(count > 0, "a mean is of something");
    expect(first.x + size.x <= size_.x && first.y + size.y <= size_.y,
           "the part lies in the picture");
    const std::size_t row = channelsOfMean * size.x;
    Picture picture{size, std::vector<std::uint8_t>(row * size.y)};
    for (std::uint32_t y = 0; y < size.y; ++y) {
        const float* from = &sums_[placeOf({first.x, first.y + y})];
        std::uint8_t* to = &picture.rgba[y * row];
        for (std::size_t i = 0; i < row; ++i) {
            const float encoded = encodedOf(from[i] / static_cast<float>(count));
            to[i] = static_cast<std::uint8_t>(std::clamp(encoded * 255.0f + 0.5f, 0.0f, 255.0f));
        }
    }
    return picture;
}

} // namespace sward::view
