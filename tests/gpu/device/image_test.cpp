#include "core/error.h"
#include "core/random.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/memory/readback.h"
#include "gpu/memory/upload.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/sampler.h"
#include "gpu/recording/commands.h"
#include "support/gpu/gpu_fixture.h"
#include "test_shaders.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace sward::gpu {
namespace {

constexpr VkImageUsageFlags textureUsage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
constexpr std::uint64_t imageSeed = 4'711;

class ImageTest : public test::GpuTest {
protected:
    static Image createTexture(VkFormat format, VkExtent2D extent, std::uint32_t mips)
    {
        return {context(),
                {.name = "texture",
                 .format = format,
                 .extent = extent,
                 .usage = textureUsage,
                 .mips = mips}};
    }

    // Uploads through staging of this size, smaller than any picture below.
    static void upload(const Image& image, std::span<const std::byte> pixels)
    {
        Uploader uploader(context(), 4'096);
        uploader.toImage(image, pixels);
        uploader.finish();
    }
};

std::vector<std::byte> randomPixels(VkFormat format, VkExtent2D extent)
{
    std::vector<std::byte> pixels(std::size_t(extent.width) * extent.height *
                                  bytesPerPixel(format));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = static_cast<std::byte>(hashBits(imageSeed, i) & 0xff);
    return pixels;
}

TEST_F(ImageTest, GivesBackWhatWasUploaded)
{
    const VkExtent2D extent{101, 67};
    for (const VkFormat format :
         {VK_FORMAT_R8_UNORM, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SRGB}) {
        const Image image = createTexture(format, extent, 1);
        const std::vector<std::byte> pixels = randomPixels(format, extent);
        upload(image, pixels);
        EXPECT_EQ(readImage(context(), image, ImageUse::sampled), pixels)
            << "format " << format << ", seed " << imageSeed;
    }
}

TEST_F(ImageTest, IsUploadedTogetherWithBuffersOfAnySize)
{
    const VkExtent2D extent{5, 3};
    const Image image = createTexture(VK_FORMAT_R8G8B8A8_UNORM, extent, 1);
    const std::vector<std::byte> pixels = randomPixels(VK_FORMAT_R8G8B8A8_UNORM, extent);
    const std::array<std::uint8_t, 3> three = {1, 2, 3};
    const Buffer buffer(
        context(), {.name = "three",
                    .bytes = three.size(),
                    .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    Uploader uploader(context());
    uploader.toBuffer(buffer, std::as_bytes(std::span(three)));
    uploader.toImage(image, pixels);
    uploader.finish();
    EXPECT_EQ(readImage(context(), image, ImageUse::sampled), pixels);
    EXPECT_EQ(readBufferAs<std::uint8_t>(context(), buffer),
              std::vector<std::uint8_t>(three.begin(), three.end()));
}

TEST_F(ImageTest, MayBeGivenUpAndFilledAnewWhileItIsStillInUse)
{
    const Image image = createTexture(VK_FORMAT_R8_UNORM, {4, 4}, 1);
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    submitAndWait(context(), [&](VkCommandBuffer commands) {
        for (const float shade : {0.0f, 1.0f}) {
            transition(commands, image, ImageUse::undefined, ImageUse::transferTarget);
            const VkClearColorValue color{{shade, 0.0f, 0.0f, 0.0f}};
            vkCmdClearColorImage(commands, image.get(), layoutOf(ImageUse::transferTarget), &color,
                                 1, &all);
        }
    });
    EXPECT_EQ(readImage(context(), image, ImageUse::transferTarget),
              std::vector<std::byte>(16, std::byte(0xff)));
}

TEST_F(ImageTest, HasMipLevelsThatAreAveragesOfFour)
{
    const VkExtent2D extent{64, 32};
    const Image image = createTexture(VK_FORMAT_R8_UNORM, extent, completeMips(extent));
    ASSERT_EQ(image.mips(), 7U);
    upload(image, randomPixels(VK_FORMAT_R8_UNORM, extent));

    for (std::uint32_t level = 1; level < image.mips(); ++level) {
        const std::vector<std::byte> fine =
            readImage(context(), image, ImageUse::sampled, level - 1);
        const std::vector<std::byte> coarse = readImage(context(), image, ImageUse::sampled, level);
        const VkExtent2D fineSize = image.extent(level - 1);
        const VkExtent2D size = image.extent(level);
        ASSERT_EQ(coarse.size(), std::size_t(size.width) * size.height);
        if (fineSize.height == 1)
            continue;
        for (std::uint32_t y = 0; y < size.height; ++y)
            for (std::uint32_t x = 0; x < size.width; ++x) {
                double sum = 0.0;
                for (std::uint32_t corner = 0; corner < 4; ++corner)
                    sum += std::to_integer<int>(
                        fine[(2 * y + corner / 2) * fineSize.width + 2 * x + corner % 2]);
                ASSERT_NEAR(std::to_integer<int>(coarse[y * size.width + x]), sum / 4.0, 1.0)
                    << "level " << level << ", pixel " << x << ", " << y;
            }
    }
}

TEST_F(ImageTest, ReachesShadersThroughAnImageSet)
{
    // Two textures of known numbers, one of them with a second level, and an image to write to.
    const VkExtent2D extent{16, 8};
    std::vector<float> numbers(extent.width * extent.height);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = static_cast<float>(uniform(imageSeed, i, 0));
    const Image first = createTexture(VK_FORMAT_R32_SFLOAT, extent, 1);
    const Image second = createTexture(VK_FORMAT_R8_UNORM, {2, 2}, 2);
    const std::array<std::uint8_t, 4> four = {0, 100, 100, 200};
    upload(first, std::as_bytes(std::span(numbers)));
    upload(second, std::as_bytes(std::span(four)));
    const Image target(context(),
                       {.name = "target",
                        .format = VK_FORMAT_R32_SFLOAT,
                        .extent = extent,
                        .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});

    const Sampler sampler =
        createSampler(context(), {.name = "nearest", .filter = VK_FILTER_NEAREST});
    const ImageSetLayout layout(context(), {.name = "images",
                                            .sampledCount = 2,
                                            .storageCount = 1,
                                            .stages = VK_SHADER_STAGE_COMPUTE_BIT});
    ImageSet images(context(), layout, "images");
    images.setSampled(0, first.view(), sampler.get());
    images.setSampled(1, second.view(), sampler.get());
    images.setStorage(0, target.view());

    struct Push {
        std::uint32_t source;
        float level;
    };
    const ComputePipeline pipeline(context(), test::testShaders(),
                                   {.name = "images",
                                    .shader = "images.comp",
                                    .pushConstantBytes = sizeof(Push),
                                    .setLayouts = {layout.get()}});
    const auto run = [&](const Push& push) {
        submitAndWait(context(), [&](VkCommandBuffer commands) {
            transition(commands, target, ImageUse::undefined, ImageUse::storage);
            pipeline.bind(commands);
            images.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout());
            pipeline.push(commands, push);
            vkCmdDispatch(commands, 2, 1, 1);
        });
        const std::vector<std::byte> bytes = readImage(context(), target, ImageUse::storage);
        std::vector<float> pixels(bytes.size() / sizeof(float));
        std::memcpy(pixels.data(), bytes.data(), bytes.size());
        return pixels;
    };

    EXPECT_EQ(run({.source = 0, .level = 0.0f}), numbers);
    for (const float pixel : run({.source = 1, .level = 1.0f}))
        ASSERT_NEAR(pixel, 100.0f / 255.0f, 1.0f / 255.0f);
}

TEST_F(ImageTest, ThatTheDeviceCannotMakeIsNamed)
{
    const std::uint32_t tooWide = context().limits.maxImageDimension2D * 2;
    try {
        createTexture(VK_FORMAT_R8_UNORM, {tooWide, 1}, 1);
        FAIL() << "an image of " << tooWide << " pixels was made";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_NE(std::string(error.what()).find("texture"), std::string::npos);
    }
}

TEST(MipCount, ReachesDownToOnePixel)
{
    EXPECT_EQ(completeMips({1, 1}), 1U);
    EXPECT_EQ(completeMips({2, 1}), 2U);
    EXPECT_EQ(completeMips({255, 256}), 9U);
    EXPECT_EQ(completeMips({1920, 1080}), 11U);
}

} // namespace
} // namespace sward::gpu
