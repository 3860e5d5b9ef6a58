#include "apps/sward_view/headless/reference_sum.h"

#include "core/expect.h"
#include "core/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::view {
namespace {

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

glm::vec2 referenceJitter(std::uint32_t index)
{
    return {radicalInverse(index + 1, 2) - 0.5f, radicalInverse(index + 1, 3) - 0.5f};
}

ReferenceSum::ReferenceSum(glm::uvec2 size)
    : size_(size)
    , sums_(4 * std::size_t(size.x) * size.y)
{
}

void ReferenceSum::add(const Picture& picture)
{
    static const std::array<float, 256> linear = linearTable();
    expect(picture.rgba.size() == sums_.size(), "all pictures of a mean have one size");
    for (std::size_t i = 0; i < sums_.size(); ++i)
        sums_[i] += linear[picture.rgba[i]];
    ++count_;
}

Picture ReferenceSum::mean() const
{
    expect(count_ > 0, "a mean is of something");
    Picture picture{size_, std::vector<std::uint8_t>(sums_.size())};
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const float encoded = encodedOf(sums_[i] / static_cast<float>(count_));
        picture.rgba[i] =
            static_cast<std::uint8_t>(std::clamp(encoded * 255.0f + 0.5f, 0.0f, 255.0f));
    }
    return picture;
}

} // namespace sward::view
