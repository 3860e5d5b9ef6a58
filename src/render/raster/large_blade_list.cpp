#include "render/raster/large_blade_list.h"

#include <cstddef>
#include <cstdint>

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

} // namespace

LargeBladeList::LargeBladeList(const gpu::DeviceContext& context, bool hasLarge)
    : cut_(context, {.name = "raster/cut blades",
                     .bytes = shared::maxCutBlades * sizeof(shared::LargePart),
                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT})
    , counts_(context,
              {.name = "raster/large blades' count",
               .bytes = sizeof(Counts),
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                        VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT})
{
    if (hasLarge)
        parts_ = gpu::Buffer(context, {.name = "raster/large blades",
                                       .bytes = shared::maxLargeParts * sizeof(shared::LargePart),
                                       .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
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
