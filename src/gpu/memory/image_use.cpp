#include "gpu/memory/image_use.h"

#include "gpu/recording/barrier.h"

namespace sward::gpu {
namespace {

struct State {
    VkImageLayout layout;
    Access access;
};

State stateOf(ImageUse use)
{
    switch (use) {
    case ImageUse::colorTarget:
        return {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                 VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT}};
    case ImageUse::depthTarget:
        return {VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                     VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT}};
    case ImageUse::sampled:
        return {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                {shaderStages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}};
    case ImageUse::storage:
        return {VK_IMAGE_LAYOUT_GENERAL,
                {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                 VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}};
    case ImageUse::transferSource:
        return {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT}};
    case ImageUse::transferTarget:
        return {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}};
    case ImageUse::present:
        // The presentation's semaphore orders later accesses.
        return {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE}};
    case ImageUse::undefined:
        break;
    }
    // An image reused every frame waits for all accesses of the frame before.
    return {VK_IMAGE_LAYOUT_UNDEFINED, anyAccess};
}

void record(const Recording& commands, VkImage image, const VkImageSubresourceRange& range,
            ImageUse before, ImageUse after)
{
    const State from = stateOf(before);
    const State to = stateOf(after);
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = from.access.stages;
    barrier.srcAccessMask = from.access.accesses;
    barrier.dstStageMask = to.access.stages;
    barrier.dstAccessMask = to.access.accesses;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = range;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    commands.vk->CmdPipelineBarrier2(commands, &dependency);
}

} // namespace

VkImageLayout layoutOf(ImageUse use)
{
    return stateOf(use).layout;
}

void transition(const Recording& commands, VkImage image, VkImageAspectFlags aspect,
                ImageUse before, ImageUse after)
{
    record(commands, image, {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}, before, after);
}

void transition(const Recording& commands, const Image& image, ImageUse before, ImageUse after)
{
    transition(commands, image.get(), image.aspect(), before, after);
}

void transitionMip(const Recording& commands, const Image& image, std::uint32_t level,
                   ImageUse before, ImageUse after)
{
    record(commands, image.get(), {image.aspect(), level, 1, 0, 1}, before, after);
}

} // namespace sward::gpu
