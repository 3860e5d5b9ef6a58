#include "gpu/memory/staged_upload.h"

#include "core/expect.h"
#include "gpu/recording/barrier.h"

#include <algorithm>
#include <cstring>

namespace sward::gpu {

StagedUpload::StagedUpload(const DeviceContext& context)
    : context_(&context)
{
}

void StagedUpload::toBuffer(const Buffer& target, std::span<const std::byte> bytes,
                            VkDeviceSize offset)
{
    expect(offset <= target.bytes() && bytes.size() <= target.bytes() - offset,
           "the bytes fit into the buffer");
    if (bytes.empty())
        return;
    Buffer staging(*context_, {.name = "staging",
                               .bytes = bytes.size(),
                               .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                               .memory = MemoryUse::upload});
    std::memcpy(staging.mapped().data(), bytes.data(), bytes.size());
    copies_.push_back({std::move(staging), target.get(), offset});
}

void StagedUpload::record(const Recording& commands, VkDeviceSize maxBytes) noexcept
{
    if (isRecorded() || maxBytes == 0)
        return;
    while (!isRecorded() && maxBytes > 0) {
        const Copy& copy = copies_[next_];
        const VkDeviceSize size = std::min(copy.staging.bytes() - recorded_, maxBytes);
        const VkBufferCopy region{recorded_, copy.offset + recorded_, size};
        commands.vk->CmdCopyBuffer(commands, copy.staging.get(), copy.target, 1, &region);
        recorded_ += size;
        maxBytes -= size;
        if (recorded_ == copy.staging.bytes()) {
            ++next_;
            recorded_ = 0;
        }
    }
    memoryBarrier(commands, transferAccess, anyAccess);
}

void StagedUpload::release()
{
    expect(isRecorded(), "what is staged has been recorded before it is given up");
    copies_.clear();
    next_ = 0;
}

VkDeviceSize StagedUpload::bytes() const
{
    VkDeviceSize sum = 0;
    for (const Copy& copy : copies_)
        sum += copy.staging.bytes();
    return sum;
}

} // namespace sward::gpu
