#include "render/raster/large_blade_list.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace sward::render {
namespace {

/// Layout of shared::RasterPush::largeCount.
struct Counts {
    shared::WalkLevel parts{.groups = {0, 1, 1}, .count = 0};
    shared::WalkLevel early{.groups = {0, 1, 1}, .count = 0};
    shared::WalkLevel cut{.groups = {0, 1, 1}, .count = 0};
    shared::WalkLevel late{.groups = {0, 1, 1}, .count = 0};
};
static_assert(offsetof(Counts, early) == shared::largeEarly * sizeof(shared::WalkLevel) &&
              offsetof(Counts, cut) == shared::largeCut * sizeof(shared::WalkLevel) &&
              offsetof(Counts, late) == shared::largeLate * sizeof(shared::WalkLevel));

VkDeviceSize shownBytes(std::uint32_t blades)
{
    return (blades / shared::seenOfWord + 1) * sizeof(std::uint32_t);
}

gpu::Buffer shownFor(const gpu::DeviceContext& context, std::uint32_t blades)
{
    return {context,
            {.name = "raster/quarters that frames have shown",
             .bytes = shownBytes(blades),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT}};
}

} // namespace

LargeBladeList::LargeBladeList(const gpu::DeviceContext& context, Room room)
    : cut_(context, {.name = "raster/cut blades",
                     .bytes = shared::maxCutBlades * sizeof(shared::LargePart),
                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT})
    , counts_(context,
              {.name = "raster/large blades' count",
               .bytes = sizeof(Counts),
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                        VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT})
{
    if (room.large)
        parts_ = gpu::Buffer(context, {.name = "raster/large blades",
                                       .bytes = shared::maxLargeParts * sizeof(shared::LargePart),
                                       .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
    if (room.shownBlades == 0)
        return;
    shown_ = shownFor(context, room.shownBlades);
}

bool LargeBladeList::hasRoomFor(std::uint32_t blades) const
{
    return shown_.bytes() == 0 || shownBytes(blades) <= shown_.bytes();
}

gpu::Buffer LargeBladeList::growShown(const gpu::DeviceContext& context, std::uint32_t blades)
{
    isCleared_ = false;
    return std::exchange(shown_, shownFor(context, blades));
}

void LargeBladeList::describe(shared::RasterPush& push) const
{
    push.large = parts_.address();
    push.largeCount = counts_.address();
    push.cut = cut_.address();
}

void LargeBladeList::clear(const gpu::Recording& commands) const
{
    const Counts none{};
    commands.vk->CmdUpdateBuffer(commands, counts_.get(), 0, sizeof none, &none);
}

void LargeBladeList::beginShown(const gpu::Recording& commands)
{
    if (!isCleared_ && shown_.bytes() > 0)
        commands.vk->CmdFillBuffer(commands, shown_.get(), 0, VK_WHOLE_SIZE, 0);
    isCleared_ = true;
    ++frame_;
}

void LargeBladeList::dispatch(const gpu::Recording& commands) const
{
    commands.vk->CmdDispatchIndirect(commands, counts_.get(), offsetof(Counts, parts));
}

void LargeBladeList::dispatchLate(const gpu::Recording& commands) const
{
    commands.vk->CmdDispatchIndirect(commands, counts_.get(), offsetof(Counts, late));
}

void LargeBladeList::dispatchCut(const gpu::Recording& commands) const
{
    commands.vk->CmdDispatchIndirect(commands, counts_.get(), offsetof(Counts, cut));
}

} // namespace sward::render
