#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "render/frame.h"
#include "render/frame_settings.h"
#include "shaders/shared/frame.h"

namespace sward::render {

/// What a frame knows in more than one: its sources of wind and its colliders, in memory that the
/// CPU writes and the device reads.
class FrameTables {
public:
    explicit FrameTables(const gpu::DeviceContext& context);

    /// Writes the tables for a frame at `time` [s] after one at `before`, and what the frame knows
    /// of wind and colliders into `frame`. At most shared::maxWindSources and shared::maxColliders
    /// of each.
    void write(const FieldShape& field, const FrameSettings& settings, double time, double before,
               shared::Frame& frame) const;

    static VkDeviceSize bytes();

private:
    gpu::Buffer buffer_;
};

} // namespace sward::render
