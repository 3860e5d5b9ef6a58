#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/rendering.h"
#include "support/gpu/gpu_fixture.h"
#include "test_shaders.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <set>

namespace sward::gpu {
namespace {

constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;
constexpr VkExtent2D extent{64, 64};

struct Push {
    std::array<float, 4> color;
    float reach;
    float depth;
};

constexpr std::array<float, 4> black = {0.0f, 0.0f, 0.0f, 1.0f};
constexpr std::array<float, 4> red = {1.0f, 0.0f, 0.0f, 1.0f};
constexpr std::array<float, 4> green = {0.0f, 1.0f, 0.0f, 1.0f};

class GraphicsPipelineTest : public test::GpuTest {
protected:
    static GraphicsPipelineSettings cornerSettings(std::uint32_t samples)
    {
        return {.name = "corner",
                .vertexShader = "corner.vert",
                .fragmentShader = "plain.frag",
                .pushConstantBytes = sizeof(Push),
                .colorFormats = {colorFormat},
                .depthFormat = depthFormat,
                .samples = samples};
    }

    // Draws one primitive per push onto black, far depth; returns packed RGBA.
    static std::vector<std::uint32_t> draw(const GraphicsPipelineSettings& settings,
                                           std::span<const Push> pushes)
    {
        const GraphicsPipeline pipeline(context(), test::testShaders(), settings);
        const VkImageUsageFlags drawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        const Image color(context(), {.name = "color",
                                      .format = colorFormat,
                                      .extent = extent,
                                      .usage = drawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
        const Image depth(context(), {.name = "depth",
                                      .format = depthFormat,
                                      .extent = extent,
                                      .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                      .samples = settings.samples});
        Image several;
        if (settings.samples > 1)
            several = Image(context(), {.name = "samples",
                                        .format = colorFormat,
                                        .extent = extent,
                                        .usage = drawn,
                                        .samples = settings.samples});

        submitAndWait(context(), [&](VkCommandBuffer commands) {
            transition(commands, color, ImageUse::undefined, ImageUse::colorTarget);
            transition(commands, depth, ImageUse::undefined, ImageUse::depthTarget);
            ColorAttachment attachment{.view = color.view(), .clear = black};
            if (settings.samples > 1) {
                transition(commands, several, ImageUse::undefined, ImageUse::colorTarget);
                attachment = {.view = several.view(),
                              .resolve = color.view(),
                              .clear = black,
                              .isKept = false};
            }
            const RenderingScope rendering(commands, extent, {&attachment, 1},
                                           DepthAttachment{.view = depth.view(), .clear = 0.0f});
            pipeline.bind(commands);
            for (const Push& push : pushes) {
                pipeline.push(commands, push);
                vkCmdDraw(commands, settings.patchControlPoints > 0 ? 1 : 3, 1, 0, 0);
            }
        });

        const std::vector<std::byte> bytes = readImage(context(), color, ImageUse::colorTarget);
        std::vector<std::uint32_t> pixels(bytes.size() / sizeof(std::uint32_t));
        std::memcpy(pixels.data(), bytes.data(), bytes.size());
        return pixels;
    }
};

constexpr std::uint32_t blackPixel = 0xff000000;
constexpr std::uint32_t redPixel = 0xff0000ff;
constexpr std::uint32_t greenPixel = 0xff00ff00;

TEST_F(GraphicsPipelineTest, DrawsATriangleOverEveryPixelWithOneAndWithFourSamples)
{
    for (const std::uint32_t samples : {1U, 4U}) {
        const Push push{red, 3.0f, 0.5f};
        const auto pixels = draw(cornerSettings(samples), {&push, 1});
        const std::set<std::uint32_t> colors(pixels.begin(), pixels.end());
        EXPECT_EQ(colors, std::set<std::uint32_t>{redPixel}) << samples << " samples";
    }
}

TEST_F(GraphicsPipelineTest, SmoothsTheEdgeWithFourSamplesAlone)
{
    const Push push{red, 1.0f, 0.5f};
    for (const std::uint32_t samples : {1U, 4U}) {
        const auto pixels = draw(cornerSettings(samples), {&push, 1});
        for (std::uint32_t y = 0; y < extent.height; ++y)
            for (std::uint32_t x = 0; x < extent.width; ++x) {
                // The edge runs through the pixels with x + y = 63.
                const std::uint32_t pixel = pixels[y * extent.width + x];
                if (x + y < extent.width - 1) {
                    ASSERT_EQ(pixel, redPixel) << x << ", " << y;
                } else if (x + y > extent.width - 1) {
                    ASSERT_EQ(pixel, blackPixel) << x << ", " << y;
                } else if (samples > 1) {
                    ASSERT_NE(pixel, redPixel) << x << ", " << y;
                    ASSERT_NE(pixel, blackPixel) << x << ", " << y;
                }
            }
    }
}

TEST_F(GraphicsPipelineTest, KeepsTheNearerOfTwoTrianglesWhoeverComesFirst)
{
    // Reversed Z: the greater depth is the nearer.
    const std::array<Push, 2> farFirst = {Push{red, 3.0f, 0.25f}, Push{green, 3.0f, 0.75f}};
    const std::array<Push, 2> nearFirst = {farFirst[1], farFirst[0]};
    EXPECT_EQ(draw(cornerSettings(1), farFirst)[0], greenPixel);
    EXPECT_EQ(draw(cornerSettings(1), nearFirst)[0], greenPixel);

    // Without the test the last one stays.
    GraphicsPipelineSettings untested = cornerSettings(1);
    untested.depthTest = false;
    EXPECT_EQ(draw(untested, nearFirst)[0], redPixel);
}

TEST_F(GraphicsPipelineTest, TessellatesAPatch)
{
    GraphicsPipelineSettings settings = cornerSettings(1);
    settings.vertexShader = "patch.vert";
    settings.tessellationControlShader = "patch.tesc";
    settings.tessellationEvaluationShader = "patch.tese";
    settings.patchControlPoints = 1;
    const Push push{green, 0.5f, 0.5f};
    const auto pixels = draw(settings, {&push, 1});
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const bool isInside = x >= 16 && x < 48 && y >= 16 && y < 48;
            ASSERT_EQ(pixels[y * extent.width + x], isInside ? greenPixel : blackPixel)
                << x << ", " << y;
        }
}

TEST_F(GraphicsPipelineTest, BlendsByAlpha)
{
    GraphicsPipelineSettings settings = cornerSettings(1);
    settings.blend = Blend::alpha;
    const Push push{{1.0f, 0.0f, 0.0f, 0.25f}, 3.0f, 0.5f};
    const std::uint32_t pixel = draw(settings, {&push, 1})[0];
    EXPECT_NEAR(pixel & 0xff, 0.25 * 255.0, 1.0);
    EXPECT_EQ(pixel >> 24, 0xffU);
}

TEST_F(GraphicsPipelineTest, CullsTheSideThatIsTurnedAway)
{
    // The corner's vertices run clockwise on the screen, so it shows its back.
    GraphicsPipelineSettings settings = cornerSettings(1);
    const Push push{red, 3.0f, 0.5f};
    settings.cullMode = VK_CULL_MODE_BACK_BIT;
    EXPECT_EQ(draw(settings, {&push, 1})[0], blackPixel);
    settings.cullMode = VK_CULL_MODE_FRONT_BIT;
    EXPECT_EQ(draw(settings, {&push, 1})[0], redPixel);
}

} // namespace
} // namespace sward::gpu
