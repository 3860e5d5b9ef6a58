#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/uniform_sets.h"
#include "render/frame_place.h"
#include "render/frame_settings.h"
#include "render/frame_tables.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// A shared::Frame that the CPU writes.
class FrameConstants {
public:
    FrameConstants(const gpu::DeviceContext& context, const gpu::UniformSetLayout& layout,
                   const char* name);

    FramePlace place() const { return {buffer_.address(), set_.get(0)}; }

    /// Where the shaders will read it.
    void fill(const shared::Frame& frame) const;

private:
    gpu::Buffer buffer_;
    gpu::UniformSets set_;
};

/// What each frame in flight has of its own.
struct FrameSlot {
    FrameSlot(const gpu::DeviceContext& context, const gpu::UniformSetLayout& layout);

    FrameConstants frame;    ///< of the picture
    FrameConstants cullView; ///< as blades are culled by, where that is another
    FrameConstants listing;  ///< for listing all blades
    gpu::Buffer draw;        ///< shared::DrawArguments, read by the CPU
    FrameTables tables;

    /// Copies the counts of the update, recorded before, to where counts() finds them.
    void recordCounts(VkCommandBuffer commands, const gpu::Buffer& drawArguments) const;

    /// What became of `blades` blades, of which so many were resident, in the frame whose commands
    /// have completed.
    FrameStats counts(std::uint64_t blades, std::uint64_t resident) const;

    static VkDeviceSize bytes(); ///< of device memory
};

} // namespace sward::render
