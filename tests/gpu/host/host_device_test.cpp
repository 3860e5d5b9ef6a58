// Uses a host's own loader, allocator, callbacks and pipeline cache.

#include "core/error.h"
#include "gpu/context/host_device.h"
#include "gpu/recording/commands.h"
#include "host_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;

/// A host's allocator: pieces of few large blocks, one after the other.
class Pool {
public:
    explicit Pool(const gpu::DeviceContext& context)
        : context_(context)
    {
    }

    ~Pool()
    {
        for (const Block& block : blocks_)
            vkFreeMemory(context_.device, block.memory, nullptr);
    }

    gpu::HostMemory hooks()
    {
        return {.allocator = this, .allocate = allocate, .release = release};
    }

    std::size_t blocks() const { return blocks_.size(); }
    int given = 0;    ///< pieces in all
    int returned = 0; ///< pieces that came back

private:
    static constexpr VkDeviceSize blockBytes = VkDeviceSize(8) << 20;

    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::byte* mapped = nullptr;
        VkDeviceSize used = 0;
        std::uint32_t type = 0;
        bool isMapped = false;
    };

    static VkResult allocate(void* allocator, const gpu::MemoryRequest& request,
                             gpu::MemoryPiece& piece)
    {
        auto& pool = *static_cast<Pool*>(allocator);
        EXPECT_NE(request.requirements.memoryTypeBits >> request.type & 1u, 0u) << request.name;
        EXPECT_LE(request.requirements.size, blockBytes) << request.name;
        const VkDeviceSize alignment = request.requirements.alignment;
        for (Block& block : pool.blocks_) {
            const VkDeviceSize first = (block.used + alignment - 1) / alignment * alignment;
            if (block.type != request.type || block.isMapped != request.isMapped ||
                first + request.requirements.size > blockBytes)
                continue;
            block.used = first + request.requirements.size;
            piece.memory = block.memory;
            piece.offset = first;
            piece.mapped = block.isMapped ? block.mapped + first : nullptr;
            ++pool.given;
            piece.token = &block.type;
            return VK_SUCCESS;
        }
        VkMemoryAllocateFlagsInfo flags{};
        flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
        flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
        VkMemoryAllocateInfo create{};
        create.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        create.pNext = &flags;
        create.allocationSize = blockBytes;
        create.memoryTypeIndex = request.type;
        Block block{.type = request.type, .isMapped = request.isMapped};
        VkResult result = vkAllocateMemory(pool.context_.device, &create, nullptr, &block.memory);
        if (result == VK_SUCCESS && block.isMapped)
            result = vkMapMemory(pool.context_.device, block.memory, 0, VK_WHOLE_SIZE, 0,
                                 reinterpret_cast<void**>(&block.mapped));
        if (result != VK_SUCCESS)
            return result;
        pool.blocks_.push_back(block);
        return allocate(allocator, request, piece);
    }

    static void release(void* allocator, const gpu::MemoryPiece& piece)
    {
        EXPECT_NE(piece.token, nullptr);
        ++static_cast<Pool*>(allocator)->returned;
    }

    const gpu::DeviceContext& context_;
    std::vector<Block> blocks_;
};

/// Counts what a driver allocates for objects made with its callbacks.
struct Callbacks {
    std::map<void*, std::size_t> sizes;
    std::size_t count = 0;

    static void* allocate(void* user, std::size_t size, std::size_t alignment,
                          VkSystemAllocationScope)
    {
        auto& self = *static_cast<Callbacks*>(user);
        void* memory =
            std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        self.sizes[memory] = size;
        ++self.count;
        return memory;
    }

    static void* reallocate(void* user, void* before, std::size_t size, std::size_t alignment,
                            VkSystemAllocationScope scope)
    {
        void* memory = allocate(user, size, alignment, scope);
        if (before != nullptr)
            std::memcpy(memory, before,
                        std::min(size, static_cast<Callbacks*>(user)->sizes.at(before)));
        release(user, before);
        return memory;
    }

    static void release(void* user, void* memory)
    {
        static_cast<Callbacks*>(user)->sizes.erase(memory);
        std::free(memory);
    }
};

class HostDeviceTest : public test::GrassTest {
protected:
    gpu::HostDevice host() const
    {
        return {.instance = instance().get(),
                .physical = context().physical,
                .device = context().device,
                .queue = context().queue,
                .queueFamily = context().queueFamily,
                .features = context().features,
                .getInstanceProcAddr = vkGetInstanceProcAddr};
    }

    /// Draws with a custom context.
    std::vector<std::byte> drawnWith(const gpu::DeviceContext& own) const
    {
        auto resident = std::make_shared<ResidentField>(own, field::viewOf(field_));
        gpu::submitAndWait(context(),
                           [&](VkCommandBuffer commands) { resident->recordUpload(commands); });
        Grass grass(own, oneSlot_);
        grass.add({resident, {}});
        return drawnAlone(grass, 1.0, test::lookingFrom({1.0, 2.0, 4.0}));
    }
};

TEST_F(HostDeviceTest, DrawsTheSameByTheHostsLoaderAllocatorAndCallbacks)
{
    const auto expected = drawnWith(context());

    VkPipelineCacheCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    VkPipelineCache cache = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreatePipelineCache(context().device, &create, nullptr, &cache), VK_SUCCESS);

    Pool pool(context());
    Callbacks counted;
    const VkAllocationCallbacks callbacks{.pUserData = &counted,
                                          .pfnAllocation = Callbacks::allocate,
                                          .pfnReallocation = Callbacks::reallocate,
                                          .pfnFree = Callbacks::release,
                                          .pfnInternalAllocation = nullptr,
                                          .pfnInternalFree = nullptr};
    gpu::HostDevice device = host();
    device.allocation = &callbacks;
    device.memory = pool.hooks();
    device.pipelineCache = cache;
    const gpu::DeviceContext own = gpu::describeDevice(device);
    EXPECT_EQ(own.name, context().name);
    EXPECT_EQ(own.maxBufferBytes, context().maxBufferBytes);
    EXPECT_LT(test::pixelsApart(expected, drawnWith(own), 4), 10u);

    // All pieces were returned, from few blocks, and all of the driver's allocations.
    EXPECT_GT(pool.given, 15);
    EXPECT_EQ(pool.returned, pool.given);
    EXPECT_LT(pool.blocks(), 6u);
    EXPECT_GT(counted.count, 20u);
    EXPECT_TRUE(counted.sizes.empty());
    vkDestroyPipelineCache(context().device, cache, nullptr);
}

TEST_F(HostDeviceTest, SaysWhatTheHostsLoaderLacks)
{
    gpu::HostDevice device = host();
    device.getDeviceProcAddr = [](VkDevice vulkan, const char* name) {
        return std::string_view(name) == "vkCmdDispatchIndirect"
                   ? nullptr
                   : vkGetDeviceProcAddr(vulkan, name);
    };
    try {
        gpu::describeDevice(device);
        FAIL() << "a function is missing";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_NE(std::string(error.what()).find("vkCmdDispatchIndirect"), std::string::npos);
    }
}

} // namespace
} // namespace sward::render
