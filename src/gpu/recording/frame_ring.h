#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/recording/commands.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::gpu {

/// Frames in flight: the CPU records the next frame while the device executes another.
class FrameRing {
public:
    struct Frame {
        std::uint32_t slot;       ///< in [0, slots()): index of the frame's own buffers
        VkCommandBuffer commands; ///< being recorded
        std::uint64_t number = 0; ///< of frames begun before; with submit() it counts on
    };

    explicit FrameRing(const DeviceContext& context, std::uint32_t slots = 2);
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;
    ~FrameRing();

    /// Waits for the slot's former frame, then begins recording.
    Frame begin();

    /// Submits the result of begin().
    void submit(const Frame& frame, std::span<const VkSemaphoreSubmitInfo> waits = {},
                std::span<const VkSemaphoreSubmitInfo> signals = {});

    /// Waits for a frame that has been submitted, and perhaps for later ones of its slot.
    void wait(const Frame& frame) const;

    /// Waits for all frames.
    void finish() const;

    std::uint32_t slots() const { return static_cast<std::uint32_t>(slots_.size()); }

private:
    struct Slot {
        VkCommandBuffer commands;
        Fence done;
    };

    const DeviceContext& context_;
    CommandPool pool_;
    std::vector<Slot> slots_;
    std::uint32_t next_ = 0;
    std::uint64_t submitted_ = 0; ///< frames
};

} // namespace sward::gpu
