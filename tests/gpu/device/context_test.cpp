#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/device/features.h"
#include "gpu/memory/readback.h"
#include "gpu/memory/upload.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace sward::gpu {
namespace {

using HostDevice = test::GpuTest;

// Creates a device as a host program would: with plain Vulkan and the required features.
UniqueRoot<VkDevice, vkDestroyDevice> createHostDevice(const DeviceContext& like)
{
    FeatureChain supported;
    vkGetPhysicalDeviceFeatures2(like.physical, &supported.core);
    FeatureChain wanted;
    enableFeatures(supported, wanted);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = like.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    create.pNext = &wanted.core;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    VkDevice device = VK_NULL_HANDLE;
    EXPECT_EQ(vkCreateDevice(like.physical, &create, nullptr, &device), VK_SUCCESS);
    return UniqueRoot<VkDevice, vkDestroyDevice>(device);
}

TEST_F(HostDevice, ServesLikeOneOfOurOwnAndIsLeftAlive)
{
    const auto device = createHostDevice(context());
    VkQueue queue = VK_NULL_HANDLE;
    vkGetDeviceQueue(device.get(), context().queueFamily, 0, &queue);
    {
        const DeviceContext host = describeDevice(context().physical, device.get(),
                                                  context().queueFamily, queue, {}, false);
        EXPECT_EQ(host.name, context().name);
        EXPECT_EQ(host.subgroupSize, context().subgroupSize);

        std::vector<std::uint32_t> sent(10'000);
        std::iota(sent.begin(), sent.end(), 1U);
        const Buffer buffer(
            host, {.name = "guest",
                   .bytes = sent.size() * sizeof(std::uint32_t),
                   .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
        Uploader uploader(host, 4'096);
        uploader.toBuffer(buffer, std::span<const std::uint32_t>(sent));
        uploader.finish();
        EXPECT_EQ(readBufferAs<std::uint32_t>(host, buffer), sent);
    }
    EXPECT_EQ(vkDeviceWaitIdle(device.get()), VK_SUCCESS);
}

TEST_F(HostDevice, WithoutFeaturesLacksAllThatAreRequiredAndOursLacksNone)
{
    FeatureChain nothing;
    EXPECT_EQ(missingFeatures(nothing), requiredFeatureNames());

    FeatureChain supported;
    vkGetPhysicalDeviceFeatures2(context().physical, &supported.core);
    EXPECT_TRUE(missingFeatures(supported).empty());
}

} // namespace
} // namespace sward::gpu
