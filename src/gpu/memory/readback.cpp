#include "gpu/memory/readback.h"

#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"

#include <algorithm>

namespace sward::gpu {
namespace {

constexpr VkDeviceSize pieceBytes = VkDeviceSize(32) << 20;

Buffer createStaging(const DeviceContext& context, VkDeviceSize bytes)
{
    return {context,
            {.name = "readback",
             .bytes = bytes,
             .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             .memory = MemoryUse::readback}};
}

} // namespace

std::vector<std::byte> readBuffer(const DeviceContext& context, const Buffer& source,
                                  VkDeviceSize offset, VkDeviceSize bytes)
{
    expect(offset <= source.bytes() && bytes <= source.bytes() - offset,
           "the bytes lie in the buffer");
    std::vector<std::byte> result(bytes);
    if (bytes == 0)
        return result;

    const Buffer staging = createStaging(context, std::min(bytes, pieceBytes));
    for (VkDeviceSize done = 0; done < bytes;) {
        const VkDeviceSize size = std::min(staging.bytes(), bytes - done);
        submitAndWait(context, [&](VkCommandBuffer commands) {
            anythingToTransfer(commands);
            const VkBufferCopy region{offset + done, 0, size};
            context.vk.CmdCopyBuffer(commands, source.get(), staging.get(), 1, &region);
            anythingToHost(commands);
        });
        std::memcpy(result.data() + done, staging.mapped().data(), size);
        done += size;
    }
    return result;
}

std::vector<std::byte> readImage(const DeviceContext& context, const Image& source, ImageUse use,
                                 std::uint32_t level)
{
    expect(source.samples() == 1, "an image of several samples is resolved before it is read");
    expect(use != ImageUse::undefined, "the image has contents");
    expect(level < source.mips(), "the mip level exists");

    const VkExtent2D extent = source.extent(level);
    const VkDeviceSize bytes =
        VkDeviceSize(extent.width) * extent.height * bytesPerPixel(source.format());
    const Buffer staging = createStaging(context, bytes);
    submitAndWait(context, [&](VkCommandBuffer commands) {
        memoryBarrier(commands, anyAccess, anyAccess);
        transitionMip(commands, source, level, use, ImageUse::transferSource);
        VkBufferImageCopy region{};
        region.imageSubresource = {source.aspect(), level, 0, 1};
        region.imageExtent = {extent.width, extent.height, 1};
        context.vk.CmdCopyImageToBuffer(commands, source.get(),
                                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.get(), 1,
                                        &region);
        transitionMip(commands, source, level, ImageUse::transferSource, use);
        anythingToHost(commands);
    });
    return {staging.mapped().begin(), staging.mapped().end()};
}

} // namespace sward::gpu
