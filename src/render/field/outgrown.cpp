#include "render/field/outgrown.h"

#include "gpu/recording/barrier.h"

#include <utility>

namespace sward::render {

void ReplacedBuffers::record(const gpu::Recording& commands, std::uint32_t slot)
{
    slots_[slot].clear();
    if (waiting_.empty())
        return;
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
    for (const Outgrown& outgrown : waiting_) {
        if (outgrown.now == VK_NULL_HANDLE || outgrown.former.bytes() == 0)
            continue;
        const VkBufferCopy all{0, 0, outgrown.former.bytes()};
        commands.vk->CmdCopyBuffer(commands, outgrown.former.get(), outgrown.now, 1, &all);
        // A buffer may have been replaced twice.
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
    }
    slots_[slot] = std::exchange(waiting_, {});
}

} // namespace sward::render
