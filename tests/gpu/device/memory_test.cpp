#include "core/error.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/memory.h"
#include "support/gpu/gpu_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::gpu {
namespace {

constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags mapped =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkPhysicalDeviceMemoryProperties memoryTypes(const std::vector<VkMemoryPropertyFlags>& types)
{
    VkPhysicalDeviceMemoryProperties memory{};
    for (const VkMemoryPropertyFlags flags : types)
        memory.memoryTypes[memory.memoryTypeCount++].propertyFlags = flags;
    return memory;
}

// A discrete device: plain host memory, device memory, device memory visible to the host, cached
// host memory.
const VkPhysicalDeviceMemoryProperties discrete =
    memoryTypes({0, local, mapped, mapped | cached, local | mapped});
constexpr std::uint32_t all = ~0U;

TEST(MemoryType, IsTheOneThatSuitsWhoeverTouchesTheMemory)
{
    EXPECT_EQ(chooseMemoryType(discrete, all, MemoryUse::device), 1U);
    EXPECT_EQ(chooseMemoryType(discrete, all, MemoryUse::upload), 2U);
    EXPECT_EQ(chooseMemoryType(discrete, all, MemoryUse::readback), 3U);
    EXPECT_EQ(chooseMemoryType(discrete, all, MemoryUse::constants), 4U);
}

TEST(MemoryType, ComesFromTheAllowedOnes)
{
    EXPECT_EQ(chooseMemoryType(discrete, 0b10000, MemoryUse::device), 4U);
    EXPECT_EQ(chooseMemoryType(discrete, 0b11000, MemoryUse::upload), 3U);
    EXPECT_EQ(chooseMemoryType(discrete, 0b10100, MemoryUse::readback), 2U);
    EXPECT_EQ(chooseMemoryType(discrete, 0b00011, MemoryUse::upload), std::nullopt);
    // If the CPU cannot write to device memory.
    EXPECT_EQ(chooseMemoryType(discrete, 0b01111, MemoryUse::constants), 2U);
}

TEST(MemoryType, IsTheOnlyOneWhereMemoryIsShared)
{
    const VkPhysicalDeviceMemoryProperties shared = memoryTypes({local | mapped | cached});
    for (const MemoryUse use :
         {MemoryUse::device, MemoryUse::upload, MemoryUse::constants, MemoryUse::readback})
        EXPECT_EQ(chooseMemoryType(shared, all, use), 0U);
}

using MemoryBound = test::GpuTest;

TEST_F(MemoryBound, IsNamedWithTheThingThatDoesNotFit)
{
    // One byte more than the heap, if a buffer may have this size.
    const VkDeviceSize bytes = context().deviceLocalBytes() + 1;
    if (bytes <= context().maxBufferBytes) {
        try {
            const Buffer buffer(context(), {.name = "mammoth", .bytes = bytes});
            FAIL() << bytes << " bytes were allocated";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::runtime);
            EXPECT_THAT(error.what(), testing::HasSubstr("mammoth"));
        }
    }
    if (context().maxBufferBytes < ~VkDeviceSize(0)) {
        try {
            const Buffer buffer(context(),
                                {.name = "mammoth", .bytes = context().maxBufferBytes + 1});
            FAIL() << "a buffer beyond the bound was to be had";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::unsupported);
            EXPECT_THAT(error.what(), testing::HasSubstr("mammoth"));
        }
    }
}

} // namespace
} // namespace sward::gpu
