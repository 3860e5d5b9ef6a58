#include "render/frame_slot.h"

#include "gpu/barrier.h"

#include <cstring>

namespace sward::render {

FrameConstants::FrameConstants(const gpu::DeviceContext& context,
                               const gpu::UniformSetLayout& layout, const char* name)
    : buffer_(context,
              {.name = name,
               .bytes = sizeof(shared::Frame),
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
               .memory = gpu::MemoryUse::constants})
    , set_(context, layout, {.name = name, .buffer = buffer_.get(), .bytes = sizeof(shared::Frame)})
{
}

void FrameConstants::fill(const shared::Frame& frame) const
{
    std::memcpy(buffer_.mapped().data(), &frame, sizeof frame);
}

FrameSlot::FrameSlot(const gpu::DeviceContext& context, const gpu::UniformSetLayout& layout)
    : frame(context, layout, "frame/constants")
    , judged(context, layout, "frame/judged")
    , listing(context, layout, "frame/listing")
    , draw(context, {.name = "frame/counts",
                     .bytes = sizeof(shared::DrawArguments),
                     .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     .memory = gpu::MemoryUse::readback})
    , tables(context)
{
}

void FrameSlot::recordCounts(VkCommandBuffer commands, const gpu::Buffer& drawArguments) const
{
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    const VkBufferCopy all{0, 0, sizeof(shared::DrawArguments)};
    vkCmdCopyBuffer(commands, drawArguments.get(), draw.get(), 1, &all);
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
}

FrameStats FrameSlot::counts(std::uint64_t blades, std::uint64_t resident) const
{
    const shared::DrawArguments counts = draw.mappedAs<shared::DrawArguments>()[0];
    FrameStats stats;
    stats.total = blades;
    stats.resident = resident;
    stats.streamedOut = blades - resident;
    stats.simulated = counts.simulated;
    stats.drawn = counts.fates[shared::fateDrawn];
    stats.lod = counts.fates[shared::fateLod];
    stats.culledPatch = counts.fates[shared::fatePatch];
    stats.culledOrientation = counts.fates[shared::fateOrientation];
    stats.culledFrustum = counts.fates[shared::fateFrustum];
    stats.culledDistance = counts.fates[shared::fateDistance];
    stats.culledOcclusion = counts.fates[shared::fateOcclusion];
    return stats;
}

VkDeviceSize FrameSlot::bytes()
{
    return 3 * sizeof(shared::Frame) + sizeof(shared::DrawArguments) + FrameTables::bytes();
}

} // namespace sward::render
