#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "render/frame_settings.h"
#include "render/frame_tables.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// What each frame in flight has of its own.
struct FrameSlot {
    explicit FrameSlot(const gpu::DeviceContext& context);

    gpu::Buffer frame;   ///< shared::Frame, written by the CPU
    gpu::Buffer judged;  ///< the same as blades are judged by, where that is another
    gpu::Buffer listing; ///< the same for listing all blades
    gpu::Buffer draw;    ///< shared::DrawArguments, read by the CPU
    FrameTables tables;

    /// Copies the counts of the update, recorded before, to where counts() finds them.
    void recordCounts(VkCommandBuffer commands, const gpu::Buffer& drawArguments) const;

    /// What became of `blades` blades, of which so many were resident, in the frame whose commands
    /// have completed.
    FrameStats counts(std::uint64_t blades, std::uint64_t resident) const;

    static VkDeviceSize bytes(); ///< of device memory
};

/// Writes a frame where the shaders will read it.
void fill(const gpu::Buffer& buffer, const shared::Frame& frame);

} // namespace sward::render
