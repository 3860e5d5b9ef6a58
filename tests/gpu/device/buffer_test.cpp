#include "core/random.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/memory/upload.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace sward::gpu {
namespace {

constexpr VkBufferUsageFlags copied =
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr std::uint64_t bufferSeed = 20'240'607;

std::vector<std::uint8_t> randomBytes(std::size_t count)
{
    std::vector<std::uint8_t> bytes(count);
    for (std::size_t i = 0; i < count; ++i)
        bytes[i] = static_cast<std::uint8_t>(hashBits(bufferSeed, i));
    return bytes;
}

class BufferTest : public test::GpuTest {
protected:
    static Buffer createBuffer(VkDeviceSize bytes)
    {
        return {context(), {.name = "tested", .bytes = bytes, .usage = copied}};
    }
};

TEST_F(BufferTest, GivesBackWhatWasUploadedWhateverTheSizes)
{
    // Sizes around the staging buffer's halves of 4 096 bytes, and many times as large.
    for (const std::size_t size :
         {std::size_t(1), std::size_t(15), std::size_t(4'095), std::size_t(4'096),
          std::size_t(4'097), std::size_t(8'192), std::size_t(1'000'003)}) {
        const std::vector<std::uint8_t> sent = randomBytes(size);
        const Buffer buffer = createBuffer(size);
        Uploader uploader(context(), 8'192);
        uploader.toBuffer(buffer, std::span(sent));
        uploader.finish();
        EXPECT_EQ(readBufferAs<std::uint8_t>(context(), buffer), sent) << size << " bytes";
    }
}

TEST_F(BufferTest, GivesBackMoreThanTheDefaultStagingHolds)
{
    const std::vector<std::uint8_t> sent = randomBytes((std::size_t(70) << 20) + 5);
    const Buffer buffer = createBuffer(sent.size());
    Uploader uploader(context());
    uploader.toBuffer(buffer, std::span(sent));
    uploader.finish();
    EXPECT_TRUE(readBufferAs<std::uint8_t>(context(), buffer) == sent);
}

TEST_F(BufferTest, KeepsTheOrderOfOverlappingUploads)
{
    const Buffer buffer = createBuffer(300);
    Uploader uploader(context(), 512);
    const std::vector<std::uint8_t> ones(300, 1);
    const std::vector<std::uint8_t> twos(200, 2);
    const std::vector<std::uint8_t> threes(100, 3);
    uploader.toBuffer(buffer, std::span(ones));
    uploader.toBuffer(buffer, std::span(twos), 100);
    uploader.toBuffer(buffer, std::span(threes), 200);
    uploader.finish();

    std::vector<std::uint8_t> expected = ones;
    std::fill(expected.begin() + 100, expected.begin() + 200, std::uint8_t(2));
    std::fill(expected.begin() + 200, expected.end(), std::uint8_t(3));
    EXPECT_EQ(readBufferAs<std::uint8_t>(context(), buffer), expected);
}

TEST_F(BufferTest, ReadsAPartOfItself)
{
    const std::vector<std::uint8_t> sent = randomBytes(1'000);
    const Buffer buffer = createBuffer(sent.size());
    Uploader uploader(context(), 512);
    uploader.toBuffer(buffer, std::span(sent));
    uploader.finish();
    const std::vector<std::byte> part = readBuffer(context(), buffer, 123, 456);
    ASSERT_EQ(part.size(), 456U);
    for (std::size_t i = 0; i < part.size(); ++i)
        ASSERT_EQ(std::to_integer<std::uint8_t>(part[i]), sent[123 + i]) << "byte " << i;
}

TEST_F(BufferTest, OfNoBytesHasAnAddressAllTheSame)
{
    const Buffer buffer = createBuffer(0);
    EXPECT_EQ(buffer.bytes(), 0U);
    EXPECT_NE(buffer.address(), 0U);
    Uploader uploader(context(), 512);
    uploader.toBuffer(buffer, std::span<const std::byte>());
    uploader.finish();
    EXPECT_TRUE(readBuffer(context(), buffer, 0, 0).empty());
}

TEST_F(BufferTest, IsMappedWhereTheCpuTouchesItAlone)
{
    for (const MemoryUse use : {MemoryUse::upload, MemoryUse::constants, MemoryUse::readback}) {
        const Buffer buffer(context(),
                            {.name = "mapped", .bytes = 64, .usage = copied, .memory = use});
        ASSERT_EQ(buffer.mapped().size(), 64U);
        const std::span<std::uint32_t> words = buffer.mappedAs<std::uint32_t>();
        std::iota(words.begin(), words.end(), 7U);
        EXPECT_EQ(readBufferAs<std::uint32_t>(context(), buffer),
                  std::vector<std::uint32_t>(words.begin(), words.end()));
    }
    EXPECT_TRUE(createBuffer(64).mapped().empty());
}

} // namespace
} // namespace sward::gpu
