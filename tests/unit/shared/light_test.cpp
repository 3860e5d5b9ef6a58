// Light packed into 32 bits, as in a host's visibility buffer.

#include "shaders/shared/passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::shared {
namespace {

TEST(LightTest, IsWithinA512thOfItsLargestChannel)
{
    for (int step = -140; step < 160; ++step)
        for (const vec3 hue : {vec3(1.0f), vec3(1.0f, 0.3f, 0.0f), vec3(0.02f, 1.0f, 0.5f),
                               vec3(0.999f, 0.998f, 1.0f)}) {
            const float size = std::exp2(float(step) / 10.0f);
            const vec3 light = size * hue;
            const vec3 back = unpackLight(packLight(light));
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_LE(std::abs(back[channel] - light[channel]), size / 512.0f)
                    << size << " channel " << channel;
        }
}

TEST(LightTest, IsNeverNothing)
{
    // 0 says that no blade is seen.
    EXPECT_NE(packLight(vec3(0.0f)), 0u);
    const vec3 black = unpackLight(packLight(vec3(0.0f)));
    EXPECT_LT(std::max({black.x, black.y, black.z}), 1e-6f);
}

TEST(LightTest, IsCutOffAboveItsRange)
{
    const vec3 back = unpackLight(packLight(vec3(1e9f, -1.0f, 65408.0f)));
    EXPECT_EQ(back.x, 65408.0f);
    EXPECT_EQ(back.y, 0.0f);
    EXPECT_EQ(back.z, 65408.0f);
}

} // namespace
} // namespace sward::shared
