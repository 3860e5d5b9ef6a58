#include "render/field/blade_states.h"

#include <cstdint>
#include <utility>

namespace sward::render {
namespace {

gpu::Buffer allocate(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes)
{
    return {context,
            {.name = name,
             .bytes = bytes,
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}};
}

} // namespace

BladeStates::BladeStates(const gpu::DeviceContext& context, const BakedBlades& blades, Kept kept)
    : states_(allocate(context, "field/states", blades.placeCount() * sizeof(std::uint32_t)))
    , patchTimes_(
          allocate(context, "field/patch times", blades.patchCount() * sizeof(std::uint32_t)))
    , patchCounts_(
          allocate(context, "field/patch counts", blades.patchCount() * sizeof(std::uint32_t)))
{
    keepsBefore_ = kept.before;
    if (kept.before)
        before_ = allocate(context, "field/states before", states_.bytes());
    if (kept.etas)
        keepEtas(context);
}

void BladeStates::keepEtas(const gpu::DeviceContext& context)
{
    if (!hasEtas_)
        etas_ = allocate(context, "field/collisions", states_.bytes());
    hasEtas_ = true;
}

void BladeStates::update(const gpu::DeviceContext& context, const BakedBlades& blades,
                         OutgrownBuffers& outgrown)
{
    const auto fit = [&](gpu::Buffer& buffer, const char* name, VkDeviceSize bytes) {
        if (bytes <= buffer.bytes())
            return;
        gpu::Buffer former = std::exchange(buffer, allocate(context, name, bytes));
        outgrown.push_back({std::move(former), buffer.get()});
    };
    fit(states_, "field/states", blades.placeCount() * sizeof(std::uint32_t));
    fit(patchTimes_, "field/patch times", blades.patchCount() * sizeof(std::uint32_t));
    fit(patchCounts_, "field/patch counts", blades.patchCount() * sizeof(std::uint32_t));
    if (hasEtas_)
        fit(etas_, "field/collisions", states_.bytes());
    if (keepsBefore_)
        fit(before_, "field/states before", states_.bytes());
}

void BladeStates::describe(shared::Frame& frame) const
{
    frame.states = states_.address();
    frame.etas = etas_.address();
    frame.patchTimes = patchTimes_.address();
    frame.patchCounts = patchCounts_.address();
}

void BladeStates::rest(const gpu::Recording& commands, std::uint32_t tick) const
{
    // A state of zeros is a blade that stands straight up.
    clearEtas(commands);
    commands.vk->CmdFillBuffer(commands, states_.get(), 0, VK_WHOLE_SIZE, 0);
    settle(commands, tick);
    commands.vk->CmdFillBuffer(commands, patchCounts_.get(), 0, VK_WHOLE_SIZE,
                               shared::maxPatchBlades);
}

void BladeStates::settle(const gpu::Recording& commands, std::uint32_t tick) const
{
    commands.vk->CmdFillBuffer(commands, patchTimes_.get(), 0, VK_WHOLE_SIZE, tick);
}

void BladeStates::clearEtas(const gpu::Recording& commands) const
{
    if (etas_.address() != 0)
        commands.vk->CmdFillBuffer(commands, etas_.get(), 0, VK_WHOLE_SIZE, 0);
}

VkDeviceSize BladeStates::bytes() const
{
    return states_.bytes() + etas_.bytes() + before_.bytes() + patchTimes_.bytes() +
           patchCounts_.bytes();
}

} // namespace sward::render
