#include "gpu/memory/upload.h"

#include "core/error.h"
#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace sward::gpu {
namespace {

// Offsets of copies into images are multiples of the pixel size and of 4; 16 suits every format.
constexpr VkDeviceSize stagingAlignment = 16;

VkDeviceSize alignUp(VkDeviceSize bytes)
{
    return (bytes + stagingAlignment - 1) / stagingAlignment * stagingAlignment;
}

// The far corner of a level, for blits.
VkOffset3D farCorner(VkExtent2D extent)
{
    return {static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
}

} // namespace

Uploader::Uploader(const DeviceContext& context, VkDeviceSize stagingBytes)
    : context_(context)
    , pool_(context)
{
    expect(stagingBytes >= 2 * stagingAlignment, "the staging buffer has room");
    for (Half& half : halves_) {
        half.staging = Buffer(context, {.name = "staging",
                                        .bytes = alignUp(stagingBytes / 2),
                                        .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                        .memory = MemoryUse::upload});
        half.commands = pool_.allocate("upload");
        half.done = createFence(context, true);
    }
}

Uploader::~Uploader()
{
    // Staging memory must outlive the device's copies. A lost device copies nothing.
    for (const Half& half : halves_) {
        VkFence done = half.done.get();
        context_.vk.WaitForFences(context_.device, 1, &done, VK_TRUE, UINT64_MAX);
    }
}

void Uploader::toBuffer(const Buffer& target, std::span<const std::byte> bytes, VkDeviceSize offset)
{
    expect(offset <= target.bytes() && bytes.size() <= target.bytes() - offset,
           "the bytes fit into the buffer");

    // Wait for earlier accesses to the target.
    if (!bytes.empty())
        anythingToTransfer(halfWithRoom(1).commands);

    while (!bytes.empty()) {
        // Fill the rest of the half.
        Half& half = halfWithRoom(1);
        const VkDeviceSize room = half.staging.bytes() - half.used;
        const VkDeviceSize size = std::min<VkDeviceSize>(room, bytes.size());
        std::memcpy(half.staging.mapped().data() + half.used, bytes.data(), size);

        const VkBufferCopy region{half.used, offset, size};
        context_.vk.CmdCopyBuffer(half.commands, half.staging.get(), target.get(), 1, &region);
        half.used += alignUp(size);
        offset += size;
        bytes = bytes.subspan(size);
    }
}

void Uploader::toImage(const Image& target, std::span<const std::byte> pixels)
{
    const VkExtent2D extent = target.extent();
    const VkDeviceSize rowBytes = VkDeviceSize(extent.width) * bytesPerPixel(target.format());
    expect(pixels.size() == rowBytes * extent.height, "there are as many pixels as the image has");
    expect(rowBytes <= halves_[0].staging.bytes(), "a row fits into half of the staging buffer");

    transition(halfWithRoom(1).commands, target, ImageUse::undefined, ImageUse::transferTarget);
    for (std::uint32_t row = 0; row < extent.height;) {
        // Copy as many whole rows as fit into the half.
        Half& half = halfWithRoom(rowBytes);
        const VkDeviceSize room = (half.staging.bytes() - half.used) / rowBytes;
        const auto rows =
            static_cast<std::uint32_t>(std::min<VkDeviceSize>(room, extent.height - row));
        std::memcpy(half.staging.mapped().data() + half.used, pixels.data() + row * rowBytes,
                    rows * rowBytes);

        VkBufferImageCopy region{};
        region.bufferOffset = half.used;
        region.imageSubresource = {target.aspect(), 0, 0, 1};
        region.imageOffset = {0, static_cast<std::int32_t>(row), 0};
        region.imageExtent = {extent.width, rows, 1};
        context_.vk.CmdCopyBufferToImage(half.commands, half.staging.get(), target.get(),
                                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        half.used += alignUp(rows * rowBytes);
        row += rows;
    }
    makeMips(target);
}

void Uploader::makeMips(const Image& target)
{
    VkFormatProperties format{};
    vkGetPhysicalDeviceFormatProperties(context_.physical, target.format(), &format);
    constexpr VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
                                            VK_FORMAT_FEATURE_BLIT_SRC_BIT |
                                            VK_FORMAT_FEATURE_BLIT_DST_BIT;
    if (target.mips() > 1 && (format.optimalTilingFeatures & needed) != needed)
        fail(ErrorKind::unsupported, "{} cannot make mip levels of format {}", context_.name,
             static_cast<int>(target.format()));

    // Downsample each level into the next; a level is complete once the next has been made from it.
    VkCommandBuffer commands = halfWithRoom(1).commands;
    for (std::uint32_t level = 1; level < target.mips(); ++level) {
        transitionMip(commands, target, level - 1, ImageUse::transferTarget,
                      ImageUse::transferSource);
        VkImageBlit region{};
        region.srcSubresource = {target.aspect(), level - 1, 0, 1};
        region.srcOffsets[1] = farCorner(target.extent(level - 1));
        region.dstSubresource = {target.aspect(), level, 0, 1};
        region.dstOffsets[1] = farCorner(target.extent(level));
        context_.vk.CmdBlitImage(commands, target.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                 target.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                                 VK_FILTER_LINEAR);
        transitionMip(commands, target, level - 1, ImageUse::transferSource, ImageUse::sampled);
    }
    transitionMip(commands, target, target.mips() - 1, ImageUse::transferTarget, ImageUse::sampled);
}

void Uploader::finish()
{
    flush();
    for (const Half& half : halves_)
        wait(context_, half.done.get());
}

Uploader::Half& Uploader::halfWithRoom(VkDeviceSize bytes)
{
    if (halves_[current_].used + bytes > halves_[current_].staging.bytes())
        flush();

    // Wait until the device has copied the half before refilling it.
    Half& half = halves_[current_];
    if (!half.isRecording) {
        wait(context_, half.done.get());
        begin(half.commands);
        half.isRecording = true;
        half.used = 0;
    }
    return half;
}

void Uploader::flush()
{
    Half& half = halves_[current_];
    if (!half.isRecording)
        return;

    // Make the copies visible to all later submissions.
    memoryBarrier(half.commands, transferAccess, anyAccess);
    VkFence done = half.done.get();
    check(context_.vk.ResetFences(context_.device, 1, &done), "vkResetFences");
    endAndSubmit(context_, half.commands, done);
    half.isRecording = false;
    current_ = 1 - current_;
}

} // namespace sward::gpu
