#include "render/field/visibility_history.h"

#include "shaders/shared/passes.h"

#include <utility>

namespace sward::render {
namespace {

gpu::Buffer historyOf(const gpu::DeviceContext& context, std::uint32_t blades)
{
    return {context,
            {.name = "raster/visibility history",
             .bytes = VisibilityHistory::bytesOf(blades),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT}};
}

} // namespace

VkDeviceSize VisibilityHistory::bytesOf(std::uint32_t blades)
{
    return (blades / shared::bladesOfHistoryWord + 1) * sizeof(std::uint32_t);
}

VisibilityHistory::VisibilityHistory(const gpu::DeviceContext& context, std::uint32_t blades)
    : bits_(historyOf(context, blades))
{
}

void VisibilityHistory::begin(const gpu::Recording& commands)
{
    if (!isCleared_ && bits_.bytes() > 0)
        commands.vk->CmdFillBuffer(commands, bits_.get(), 0, VK_WHOLE_SIZE, 0);
    isCleared_ = true;
    ++frame_;
}

gpu::Buffer VisibilityHistory::grow(const gpu::DeviceContext& context, std::uint32_t blades)
{
    isCleared_ = false;
    return std::exchange(bits_, historyOf(context, blades));
}

bool VisibilityHistory::hasRoomFor(std::uint32_t blades) const
{
    return bits_.bytes() == 0 || VisibilityHistory::bytesOf(blades) <= bits_.bytes();
}

} // namespace sward::render
