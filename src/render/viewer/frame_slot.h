#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/field/frame_tables.h"
#include "render/frame/frame_place.h"
#include "render/frame/frame_settings.h"
#include "render/frame/frame_stats.h"
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

    /// Writes the constants for the shaders.
    void fill(const shared::Frame& frame) const;

private:
    gpu::Buffer buffer_;
    gpu::UniformSets set_;
};

/// Per-slot resources of frames in flight.
struct FrameSlot {
    FrameSlot(const gpu::DeviceContext& context, const gpu::UniformSetLayout& layout);

    FrameConstants frame;    ///< of the picture
    FrameConstants cullView; ///< for culling, if it has its own camera
    FrameConstants listing;  ///< for listing all blades
    gpu::Buffer draw;        ///< shared::DrawArguments, read by the CPU
    FrameTables tables;
    std::uint32_t blades = 0; ///< of the field in the frame recorded last

    /// Copies the counts of the update, recorded before, to the memory that counts() reads.
    void recordCounts(const gpu::Recording& commands, const gpu::Buffer& drawArguments) const;

    /// Statistics of these blades, `resident` of them in memory, for the slot's completed frame.
    FrameStats counts(std::uint64_t resident) const;

    static VkDeviceSize bytes(); ///< of device memory
};

} // namespace sward::render
