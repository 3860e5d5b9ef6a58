#include "apps/sward_view/headless/reference_sum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sward::view {
namespace {

Picture grey(std::uint8_t value)
{
    return {glm::uvec2(1), {value, value, value, value}};
}

TEST(ReferenceSum, OfOnePictureIsThatPicture)
{
    for (int value = 0; value < 256; ++value) {
        ReferenceSum sum(glm::uvec2(1));
        for (int i = 0; i < 256; ++i)
            sum.add(grey(static_cast<std::uint8_t>(value)));
        EXPECT_EQ(sum.mean().rgba[0], value);
    }
}

TEST(ReferenceSum, MixesLightNotNumbers)
{
    // Half of full light is 188 in sRGB (IEC 61966-2-1), not 128.
    ReferenceSum sum(glm::uvec2(1));
    sum.add(grey(0));
    sum.add(grey(255));
    EXPECT_EQ(sum.mean().rgba[0], 188);
}

TEST(ReferenceJitter, CoversThePixelEvenly)
{
    std::array<int, 16> counts{};
    glm::vec2 mean(0.0f);
    for (std::uint32_t i = 0; i < referencePictures; ++i) {
        const glm::vec2 jitter = referenceJitter(i);
        ASSERT_TRUE(jitter.x >= -0.5f && jitter.x < 0.5f && jitter.y >= -0.5f && jitter.y < 0.5f);
        mean += jitter / float(referencePictures);
        const auto column = static_cast<std::size_t>((jitter.x + 0.5f) * 4.0f);
        const auto row = static_cast<std::size_t>((jitter.y + 0.5f) * 4.0f);
        ++counts[4 * row + column];
    }
    EXPECT_LT(std::hypot(mean.x, mean.y), 0.01f);
    for (const int count : counts)
        EXPECT_NEAR(count, 16, 3);
}

} // namespace
} // namespace sward::view
