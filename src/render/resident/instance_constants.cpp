#include "render/resident/instance_constants.h"

#include "core/expect.h"
#include "gpu/pipeline/compute_pipeline.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace sward::render {
namespace {

std::uint32_t kindsOf(const InstanceConstants::Settings& settings)
{
    return settings.listsAll ? 6 : 5;
}

/// Offset of the frames in a slot's constants: after the tables.
VkDeviceSize framesOffset()
{
    return gpu::groupsFor(tableBytes(), gpu::uniformAlignment) * gpu::uniformAlignment;
}

VkDeviceSize slotBytes(const InstanceConstants::Settings& settings)
{
    return framesOffset() + settings.views * (kindsOf(settings) * sizeof(shared::Frame) +
                                              sizeof(shared::Motion) + sizeof(shared::HostLight));
}

VkDeviceSize countBytes(const InstanceConstants::Settings& settings)
{
    return (1 + settings.views) * sizeof(shared::DrawArguments);
}

} // namespace

InstanceConstants::InstanceConstants(const gpu::DeviceContext& context, const Settings& settings)
    : settings_(settings)
{
    const gpu::UniformSetLayout layout(context, "instance/frame");
    for (std::uint32_t i = 0; i < settings.slots; ++i) {
        Slot& slot = slots_.emplace_back();
        slot.bytes = gpu::Buffer(context, {.name = "instance/constants",
                                           .bytes = slotBytes(settings),
                                           .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                    VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                           .memory = gpu::MemoryUse::constants});
        slot.frames = gpu::UniformSets(context, layout,
                                       {.name = "instance/frame",
                                        .buffer = slot.bytes.get(),
                                        .offset = framesOffset(),
                                        .bytes = sizeof(shared::Frame),
                                        .count = kindsOf(settings) * settings.views});
        slot.counts = gpu::Buffer(context, {.name = "instance/counts",
                                            .bytes = countBytes(settings),
                                            .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                            .memory = gpu::MemoryUse::readback});
        std::ranges::fill(slot.counts.mapped(), std::byte{0});
    }
}

std::uint32_t InstanceConstants::frameIndex(Kind kind, std::uint32_t view) const
{
    const auto number = static_cast<std::uint32_t>(kind);
    expect(view < settings_.views && number < kindsOf(settings_), "the slot has such a frame");
    return number * settings_.views + view;
}

VkDeviceSize InstanceConstants::frameOffset(Kind kind, std::uint32_t view) const
{
    return framesOffset() + frameIndex(kind, view) * sizeof(shared::Frame);
}

VkDeviceSize InstanceConstants::motionOffset(std::uint32_t view) const
{
    return framesOffset() + kindsOf(settings_) * settings_.views * sizeof(shared::Frame) +
           view * sizeof(shared::Motion);
}

template <typename T>
VkDeviceAddress InstanceConstants::write(std::uint32_t slot, VkDeviceSize offset,
                                         const T& value) const
{
    const gpu::Buffer& bytes = slots_[slot].bytes;
    std::memcpy(bytes.mapped().data() + offset, &value, sizeof value);
    return bytes.address() + offset;
}

FramePlace InstanceConstants::place(std::uint32_t slot, Kind kind, std::uint32_t view) const
{
    return {slots_[slot].bytes.address() + frameOffset(kind, view),
            slots_[slot].frames.get(frameIndex(kind, view))};
}

void InstanceConstants::put(std::uint32_t slot, Kind kind, std::uint32_t view,
                            const shared::Frame& frame) const
{
    write(slot, frameOffset(kind, view), frame);
}

void InstanceConstants::thin(std::uint32_t slot, std::uint32_t view, float lodThreshold) const
{
    for (const Kind kind : {Kind::update, Kind::culling, Kind::drawing, Kind::raster, Kind::shadow})
        write(slot,
              frameOffset(kind, view) + offsetof(shared::Frame, view) +
                  offsetof(shared::Eyepoint, lodThreshold),
              lodThreshold);
}

TablePlace InstanceConstants::tables(std::uint32_t slot) const
{
    return {slots_[slot].bytes.mapped().data(), slots_[slot].bytes.address()};
}

VkDeviceAddress InstanceConstants::motion(std::uint32_t slot, std::uint32_t view) const
{
    return slots_[slot].bytes.address() + motionOffset(view);
}

void InstanceConstants::putMotion(std::uint32_t slot, std::uint32_t view,
                                  const shared::Motion& motion) const
{
    write(slot, motionOffset(view), motion);
}

VkDeviceAddress InstanceConstants::putLight(std::uint32_t slot, std::uint32_t view,
                                            const shared::HostLight& light) const
{
    return write(slot, motionOffset(settings_.views) + view * sizeof light, light);
}

VkDeviceSize InstanceConstants::bytesOf(const Settings& settings)
{
    return settings.slots * (slotBytes(settings) + countBytes(settings));
}

} // namespace sward::render
