#include "apps/sward_view/picture/picture_mean.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sward::view {
namespace {

Picture grey(std::uint8_t value)
{
    return {glm::uvec2(1), {value, value, value, value}};
}

TEST(PictureMean, OfOnePictureIsThatPicture)
{
    for (int value = 0; value < 256; ++value) {
        PictureMean sum(glm::uvec2(1));
        for (int i = 0; i < 256; ++i)
            sum.add(grey(static_cast<std::uint8_t>(value)));
        EXPECT_EQ(sum.mean(256).rgba[0], value);
    }
}

TEST(PictureMean, MixesLightNotNumbers)
{
    // Half of full light is 188 in sRGB (IEC 61966-2-1), not 128.
    PictureMean sum(glm::uvec2(1));
    sum.add(grey(0));
    sum.add(grey(255));
    EXPECT_EQ(sum.mean(2).rgba[0], 188);
}

TEST(PictureMean, KeepsPartsApart)
{
    PictureMean sum(glm::uvec2(2, 2));
    sum.add(grey(0), glm::uvec2(0, 1));
    sum.add(grey(255), glm::uvec2(0, 1));
    sum.add(grey(90), glm::uvec2(1, 0));
    EXPECT_EQ(sum.mean(2, glm::uvec2(0, 1), glm::uvec2(1)).rgba[0], 188);
    const Picture upper = sum.mean(1, glm::uvec2(0), glm::uvec2(2, 1));
    EXPECT_EQ(upper.rgba[0], 0);
    EXPECT_EQ(upper.rgba[4], 90);
}

TEST(SubpixelOffset, CoversThePixelEvenly)
{
    constexpr std::uint32_t pictures = 256;
    std::array<int, 16> counts{};
    glm::vec2 mean(0.0f);
    for (std::uint32_t i = 0; i < pictures; ++i) {
        const glm::vec2 offset = subpixelOffset(i);
        ASSERT_TRUE(offset.x >= -0.5f && offset.x < 0.5f && offset.y >= -0.5f && offset.y < 0.5f);
        mean += offset / float(pictures);
        const auto column = static_cast<std::size_t>((offset.x + 0.5f) * 4.0f);
        const auto row = static_cast<std::size_t>((offset.y + 0.5f) * 4.0f);
        ++counts[4 * row + column];
    }
    EXPECT_LT(std::hypot(mean.x, mean.y), 0.01f);
    for (const int count : counts)
        EXPECT_NEAR(count, 16, 3);
}

} // namespace
} // namespace sward::view
