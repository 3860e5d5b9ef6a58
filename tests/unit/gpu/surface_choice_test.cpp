#include "gpu/presentation/surface_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace sward::gpu {
namespace {

constexpr VkColorSpaceKHR srgb = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;

VkSurfaceCapabilitiesKHR capabilities(VkExtent2D current)
{
    VkSurfaceCapabilitiesKHR result{};
    result.minImageCount = 2;
    result.maxImageCount = 0;
    result.currentExtent = current;
    result.minImageExtent = {16, 16};
    result.maxImageExtent = {4'096, 2'048};
    return result;
}

constexpr VkExtent2D free{0xffffffff, 0xffffffff};

TEST(SurfaceFormat, IsAnSrgbFormatWhereverOneIsOffered)
{
    const std::vector<VkSurfaceFormatKHR> offered = {{VK_FORMAT_R5G6B5_UNORM_PACK16, srgb},
                                                     {VK_FORMAT_B8G8R8A8_UNORM, srgb},
                                                     {VK_FORMAT_R8G8B8A8_SRGB, srgb}};
    EXPECT_EQ(chooseSurfaceFormat(offered).format, VK_FORMAT_R8G8B8A8_SRGB);
}

TEST(SurfaceFormat, IsEightBitLinearBeforeAnyOther)
{
    const std::vector<VkSurfaceFormatKHR> offered = {{VK_FORMAT_R5G6B5_UNORM_PACK16, srgb},
                                                     {VK_FORMAT_R8G8B8A8_UNORM, srgb}};
    EXPECT_EQ(chooseSurfaceFormat(offered).format, VK_FORMAT_R8G8B8A8_UNORM);
    const std::vector<VkSurfaceFormatKHR> strange = {{VK_FORMAT_R5G6B5_UNORM_PACK16, srgb}};
    EXPECT_EQ(chooseSurfaceFormat(strange).format, VK_FORMAT_R5G6B5_UNORM_PACK16);
}

TEST(SurfaceExtent, IsTheSurfacesOwnIfItHasOne)
{
    const auto extent = chooseSurfaceExtent(capabilities({640, 480}), {800, 600});
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->width, 640U);
    EXPECT_EQ(extent->height, 480U);
}

TEST(SurfaceExtent, IsElseTheWantedOneWithinBounds)
{
    auto extent = chooseSurfaceExtent(capabilities(free), {800, 600});
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->width, 800U);
    EXPECT_EQ(extent->height, 600U);
    extent = chooseSurfaceExtent(capabilities(free), {10'000, 1});
    ASSERT_TRUE(extent);
    EXPECT_EQ(extent->width, 4'096U);
    EXPECT_EQ(extent->height, 16U);
}

TEST(SurfaceExtent, IsNoneWhileTheWindowIsMinimised)
{
    EXPECT_FALSE(chooseSurfaceExtent(capabilities(free), {0, 0}));
    EXPECT_FALSE(chooseSurfaceExtent(capabilities({0, 0}), {800, 600}));
    EXPECT_FALSE(chooseSurfaceExtent(capabilities({640, 480}), {0, 0}));
}

TEST(SurfaceImageCount, IsOneMoreThanTheLeastWithinTheMost)
{
    VkSurfaceCapabilitiesKHR bounds = capabilities(free);
    EXPECT_EQ(chooseImageCount(bounds), 3U);
    bounds.maxImageCount = 2;
    EXPECT_EQ(chooseImageCount(bounds), 2U);
}

} // namespace
} // namespace sward::gpu
