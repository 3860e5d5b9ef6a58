#pragma once

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/context.h"
#include "gpu/handle.h"
#include "gpu/recording.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::gpu {

/// Brings bytes into one buffer while frames go on, in batches of bounded size, each from mapped
/// memory of its own. A batch is recorded into commands of the caller's; or, where the context has
/// a queue for copies, submitted to that. Nobody waits, but for the end.
class CopyRing {
public:
    /// `context` and `target` outlive it.
    CopyRing(const DeviceContext& context, const Buffer& target, VkDeviceSize batchBytes,
             std::uint32_t batches);
    CopyRing(const CopyRing&) = delete;
    CopyRing& operator=(const CopyRing&) = delete;
    ~CopyRing(); ///< waits for what was submitted

    bool hasQueue() const { return context_.copyQueue != VK_NULL_HANDLE; }
    std::uint32_t batches() const { return static_cast<std::uint32_t>(batches_.size()); }
    VkDeviceSize batchBytes() const { return batchBytes_; }

    /// With a queue: whether the copies of a batch have been made, or it has none. Never waits.
    bool isDone(std::uint32_t batch);

    /// Empties a batch whose copies have been made.
    void begin(std::uint32_t batch);

    /// Room for `bytes` that come to `offset` of the target; empty when the batch is full. The
    /// caller fills it at once.
    std::span<std::byte> add(std::uint32_t batch, VkDeviceSize offset, VkDeviceSize bytes);

    /// Records a batch's copies, between barriers of the caller's.
    void record(const Recording& commands, std::uint32_t batch) const noexcept;

    /// Submits a batch to the queue.
    void submit(std::uint32_t batch);

    /// With a queue: what the submission of commands waits for that read what batches seen done
    /// have copied. It has happened; waiting makes it seen.
    VkSemaphoreSubmitInfo copied() const;

    VkDeviceSize bytes() const { return batches_.size() * batchBytes_; } ///< of mapped memory

private:
    struct Batch {
        Buffer staging;
        std::vector<VkBufferCopy> copies;
        VkDeviceSize used = 0;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        std::uint64_t number = 0; ///< the semaphore's value when it is done
    };

    const DeviceContext& context_;
    const Buffer& target_;
    VkDeviceSize batchBytes_;
    CommandPool pool_;
    std::vector<Batch> batches_;
    Semaphore done_;              ///< counts submissions
    std::uint64_t submitted_ = 0; ///< batches
    std::uint64_t seen_ = 0;      ///< the semaphore's value last read
};

} // namespace sward::gpu
