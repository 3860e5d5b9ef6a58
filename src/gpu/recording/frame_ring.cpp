#include "gpu/recording/frame_ring.h"

#include "core/expect.h"
#include "gpu/context/check.h"

#include <cstdint>
#include <string>

namespace sward::gpu {

FrameRing::FrameRing(const DeviceContext& context, std::uint32_t slots)
    : context_(context)
    , pool_(context)
{
    expect(slots > 0, "at least one frame is in flight");
    for (std::uint32_t i = 0; i < slots; ++i)
        slots_.push_back(
            {pool_.allocate("frame " + std::to_string(i)), createFence(context, true)});
}

FrameRing::~FrameRing()
{
    // Command buffers must outlive their execution. A lost device executes nothing.
    for (const Slot& slot : slots_) {
        VkFence done = slot.done.get();
        context_.vk.WaitForFences(context_.device, 1, &done, VK_TRUE, UINT64_MAX);
    }
}

FrameRing::Frame FrameRing::begin()
{
    const Slot& slot = slots_[next_];
    gpu::wait(context_, slot.done.get());
    gpu::begin(slot.commands);
    return {next_, slot.commands, submitted_};
}

void FrameRing::submit(const Frame& frame, std::span<const VkSemaphoreSubmitInfo> waits,
                       std::span<const VkSemaphoreSubmitInfo> signals)
{
    expect(frame.slot == next_, "frames are submitted in the order in which they were begun");

    // Reset the fence just before the submission that signals it: then no wait blocks on a frame
    // that was begun and never submitted.
    VkFence done = slots_[frame.slot].done.get();
    check(context_.vk.ResetFences(context_.device, 1, &done), "vkResetFences");
    endAndSubmit(context_, frame.commands, done, waits, signals);
    next_ = (next_ + 1) % slots();
    ++submitted_;
}

void FrameRing::wait(const Frame& frame) const
{
    expect(frame.number < submitted_, "the frame has been submitted");
    // begin() has waited for a frame whose slot was taken since.
    if (submitted_ - frame.number <= slots())
        gpu::wait(context_, slots_[frame.slot].done.get());
}

void FrameRing::finish() const
{
    for (const Slot& slot : slots_)
        gpu::wait(context_, slot.done.get());
}

} // namespace sward::gpu
