#include "render/viewer/frame_slot.h"

#include "gpu/recording/barrier.h"

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
    , cullView(context, layout, "frame/cull view")
    , listing(context, layout, "frame/listing")
    , draw(context, {.name = "frame/counts",
                     .bytes = sizeof(shared::DrawArguments),
                     .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     .memory = gpu::MemoryUse::readback})
    , tables(context)
{
}

void FrameSlot::recordCounts(const gpu::Recording& commands, const gpu::Buffer& drawArguments) const
{
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    const VkBufferCopy all{0, 0, sizeof(shared::DrawArguments)};
    commands.vk->CmdCopyBuffer(commands, drawArguments.get(), draw.get(), 1, &all);
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
}

FrameStats FrameSlot::counts(std::uint64_t resident) const
{
    const shared::DrawArguments counts = draw.mappedAs<shared::DrawArguments>()[0];
    FrameStats stats;
    stats.total = blades;
    stats.resident = resident;
    stats.streamedOut = blades - resident;
    stats.simulated = counts.simulated;
    stats.drawn = counts.cullResults[shared::cullResultDrawn];
    stats.lod = counts.cullResults[shared::cullResultLod];
    stats.culledPatch = counts.cullResults[shared::cullResultPatch];
    stats.culledOrientation = counts.cullResults[shared::cullResultOrientation];
    stats.culledFrustum = counts.cullResults[shared::cullResultFrustum];
    stats.culledDistance = counts.cullResults[shared::cullResultDistance];
    stats.culledOcclusion = counts.cullResults[shared::cullResultOcclusion];
    return stats;
}

VkDeviceSize FrameSlot::bytes()
{
    return 3 * sizeof(shared::Frame) + sizeof(shared::DrawArguments) + FrameTables::bytes();
}

} // namespace sward::render
