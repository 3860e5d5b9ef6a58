#include "render/blade_states.h"

#include <bit>

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

BladeStates::BladeStates(const gpu::DeviceContext& context, const BakedBlades& blades,
                         bool keepsBefore)
    : states_(allocate(context, "field/states", blades.placeCount() * sizeof(shared::BladeState)))
    , patchTimes_(allocate(context, "field/patch times", blades.patchCount() * sizeof(float)))
    , patchCounts_(
          allocate(context, "field/patch counts", blades.patchCount() * sizeof(std::uint32_t)))
{
    if (keepsBefore)
        before_ = allocate(context, "field/states before",
                           blades.placeCount() * sizeof(shared::BladeState));
}

void BladeStates::describe(shared::Frame& frame) const
{
    frame.states = states_.address();
    frame.patchTimes = patchTimes_.address();
    frame.patchCounts = patchCounts_.address();
}

void BladeStates::rest(const gpu::Recording& commands, float time) const
{
    // A state of zeros is a blade that stands straight up.
    commands.vk->CmdFillBuffer(commands, states_.get(), 0, VK_WHOLE_SIZE, 0);
    commands.vk->CmdFillBuffer(commands, patchTimes_.get(), 0, VK_WHOLE_SIZE,
                               std::bit_cast<std::uint32_t>(time));
    commands.vk->CmdFillBuffer(commands, patchCounts_.get(), 0, VK_WHOLE_SIZE,
                               shared::maxPatchBlades);
}

VkDeviceSize BladeStates::bytes() const
{
    return states_.bytes() + before_.bytes() + patchTimes_.bytes() + patchCounts_.bytes();
}

} // namespace sward::render
