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

namespace {

VkDeviceSize bytesOf(const Image& source, std::uint32_t level)
{
    const VkExtent2D extent = source.extent(level);
    return VkDeviceSize(extent.width) * extent.height * bytesPerPixel(source.format());
}

void copyToStaging(const DeviceContext& context, const Image& source, ImageUse use,
                   std::uint32_t level, const Buffer& staging)
{
    expect(source.samples() == 1, "an image of several samples is resolved before it is read");
    expect(use != ImageUse::undefined, "the image has contents");
    expect(level < source.mips(), "the mip level exists");

    const VkExtent2D extent = source.extent(level);
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
}

} // namespace

std::vector<std::byte> readImage(const DeviceContext& context, const Image& source, ImageUse use,
                                 std::uint32_t level)
{
    const Buffer staging = createStaging(context, bytesOf(source, level));
    copyToStaging(context, source, use, level, staging);
    return {staging.mapped().begin(), staging.mapped().end()};
}

std::span<const std::byte> readImage(const DeviceContext& context, const Image& source,
                                     ImageUse use, Buffer& staging)
{
    const VkDeviceSize bytes = bytesOf(source, 0);
    if (staging.bytes() < bytes)
        staging = createStaging(context, bytes);
    copyToStaging(context, source, use, 0, staging);
    return staging.mapped().first(bytes);
}

} // namespace sward::gpu
