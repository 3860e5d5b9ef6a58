#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/memory/buffer.h"
#include "gpu/recording/command_pool.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::gpu {

/// Copies bytes into one buffer while frames continue, in batches of bounded size, each with its
/// own mapped memory. The caller's command buffer records a batch; or, if the ring uses the
/// context's copy queue, the batch is submitted there. Only the destructor waits.
class CopyRing {
public:
    /// `context` and `target` outlive it. `usesQueue`: if the context has a copy queue.
    CopyRing(const DeviceContext& context, const Buffer& target, VkDeviceSize batchBytes,
             std::uint32_t batches, bool usesQueue = true);
    CopyRing(const CopyRing&) = delete;
    CopyRing& operator=(const CopyRing&) = delete;
    ~CopyRing(); ///< waits for what was submitted

    bool hasQueue() const { return hasQueue_; }
    std::uint32_t batches() const { return static_cast<std::uint32_t>(batches_.size()); }
    VkDeviceSize batchBytes() const { return batchBytes_; }

    /// With a queue: whether the batch's copies have completed, or it has none. Never waits.
    bool isDone(std::uint32_t batch);

    /// Empties a batch whose copies have completed.
    void begin(std::uint32_t batch);

    /// Mapped memory for `bytes` that go to `offset` of the target; empty if the batch is full. The
    /// caller fills it immediately.
    std::span<std::byte> add(std::uint32_t batch, VkDeviceSize offset, VkDeviceSize bytes);

    /// Records a batch's copies. The caller records barriers before and after.
    void record(const Recording& commands, std::uint32_t batch) const noexcept;

    /// Submits a batch to the queue.
    void submit(std::uint32_t batch);

    /// With a queue: the semaphore wait for submissions that read batches for which isDone()
    /// returned true. It is already signalled; the wait makes the copies visible.
    VkSemaphoreSubmitInfo copied() const;

    VkDeviceSize bytes() const { return batches_.size() * batchBytes_; } ///< of mapped memory

private:
    struct Batch {
        Buffer staging;
        std::vector<VkBufferCopy> copies;
        VkDeviceSize used = 0;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        std::uint64_t number = 0; ///< the semaphore's value when the batch is done
    };

    const DeviceContext& context_;
    const Buffer& target_;
    VkDeviceSize batchBytes_;
    bool hasQueue_;
    CommandPool pool_;
    std::vector<Batch> batches_;
    Semaphore done_;              ///< counts submissions
    std::uint64_t submitted_ = 0; ///< batches
    std::uint64_t seen_ = 0;      ///< the semaphore's value last read
};

} // namespace sward::gpu
