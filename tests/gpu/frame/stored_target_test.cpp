// A target that shaders store to gives the same bytes as one that is copied to.

#include "core/error.h"
#include "picture.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "thicket.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

constexpr gpu::ImageSettings settingsOf(VkFormat format, VkFormat storedAs)
{
    return {.format = format,
            .extent = {16, 16},
            .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
            .storedAs = storedAs};
}

class StoredTarget : public test::GpuTest {
protected:
    /// Some GPUs lack storage support; the software driver has it.
    static bool canBe(VkFormat format)
    {
        const bool isThere =
            gpu::isSupported(context(), settingsOf(format, VK_FORMAT_R8G8B8A8_UNORM));
        EXPECT_TRUE(isThere || !context().isCpu());
        return isThere;
    }
};

/// Alternates between two stored targets and one copied target, with changing sizes, with and
/// without tile sorting and soft grass.
TEST_F(StoredTarget, HasTheBytesOfOneThatIsCopiedTo)
{
    if (!canBe(VK_FORMAT_R8G8B8A8_SRGB))
        GTEST_SKIP() << "this device stores into no encoded colours";
    const field::Field field = test::makeField({.blades = 3000, .extent = 8.0f});
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    for (const std::uint32_t samples : {1u, 4u})
        for (const bool forCpu : {false, true}) {
            const FieldRendererSettings wanted{
                .samples = samples, .geometry = Geometry::raster, .rastersForCpu = forCpu};
            FieldRenderer copies(device(), field::viewOf(field), wanted);
            FieldRenderer stores(device(), field::viewOf(field), wanted);
            for (const glm::uvec2 size : {glm::uvec2(97, 55), glm::uvec2(16, 16)}) {
                test::Picture copied(context(), size);
                // A renderer handles each target by its usage: the third is copied to.
                test::Picture targets[3] = {test::Picture(context(), size, true),
                                            test::Picture(context(), size, true),
                                            test::Picture(context(), size)};
                for (int step = 0; step < 3; ++step) {
                    SCOPED_TRACE(testing::Message() << samples << " samples, " << size.x << " × "
                                                    << size.y << ", step " << step);
                    // Distant blades are finer than a pixel, and the picture is soft.
                    Camera camera;
                    camera.eye = {0.0, 6.0, 18.0 + 20.0 * step};
                    const double time = 1.0 + 0.1 * step;
                    copied.draw(copies, camera, settings, time);
                    targets[step].draw(stores, camera, settings, time);
                    EXPECT_EQ(test::differingPixels(copied.pixels(), targets[step].pixels()),
                              0u);
                    EXPECT_GT(stores.stats().drawn, 0u);
                }
            }
        }
}

/// A stored target may have the reversed channel order.
TEST_F(StoredTarget, MayHaveBlueFirst)
{
    constexpr VkFormat format = VK_FORMAT_B8G8R8A8_SRGB;
    if (!canBe(format))
        GTEST_SKIP() << "this device stores into no encoded colours";
    const field::Field field = test::makeField({.blades = 500, .extent = 4.0f});
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    FieldRendererSettings wanted{.samples = 1, .geometry = Geometry::raster};
    FieldRenderer redFirst(device(), field::viewOf(field), wanted);
    wanted.colorFormat = format;
    FieldRenderer blueFirst(device(), field::viewOf(field), wanted);
    constexpr glm::uvec2 size(64, 36);
    test::Picture expected(context(), size);
    test::Picture stored(context(), size, true, format);
    Camera camera;
    camera.eye = {0.0, 4.0, 9.0};
    expected.draw(redFirst, camera, settings, 1.0);
    stored.draw(blueFirst, camera, settings, 1.0);
    std::vector<std::byte> turned = stored.pixels();
    for (std::size_t i = 0; i + 3 < turned.size(); i += 4)
        std::swap(turned[i], turned[i + 2]);
    EXPECT_EQ(test::differingPixels(expected.pixels(), turned), 0u);
    EXPECT_GT(test::differingPixels(expected.pixels(), stored.pixels()), size.x * size.y / 2);
}

TEST_F(StoredTarget, IsOfAFormatThatShadersStore)
{
    const gpu::ImageSettings depths = settingsOf(VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_D32_SFLOAT);
    EXPECT_FALSE(gpu::isSupported(context(), depths));
    EXPECT_THROW(gpu::Image(context(), depths), Error);
    gpu::ImageSettings large = settingsOf(VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_UNDEFINED);
    EXPECT_TRUE(gpu::isSupported(context(), large));
    large.extent.width = 1u << 24;
    EXPECT_FALSE(gpu::isSupported(context(), large));
    EXPECT_THROW(gpu::Image(context(), large), Error);
}

} // namespace
} // namespace sward::render
