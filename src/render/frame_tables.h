#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "render/frame.h"
#include "render/frame_settings.h"
#include "shaders/shared/frame.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sward::render {

/// Mapped memory for a frame's tables, and where the device finds it.
struct TablePlace {
    std::byte* mapped = nullptr; ///< tableBytes() of them
    VkDeviceAddress address = 0;
};
VkDeviceSize tableBytes();

/// Writes a frame's colliders, and what it knows of them and its sources of wind into `frame`, both
/// as `field` counts. At most shared::maxWindSources and shared::maxColliders of each.
void writeTables(TablePlace place, const FieldShape& field, const std::vector<WindSource>& winds,
                 std::span<const shared::Collider> colliders, shared::Frame& frame);

/// What a frame knows in more than one: its colliders, in memory that the CPU writes and the device
/// reads.
class FrameTables {
public:
    explicit FrameTables(const gpu::DeviceContext& context);

    /// Writes the table for a frame at `time` [s] after one at `before`, and what the frame knows
    /// of wind and colliders into `frame`. At most shared::maxWindSources and shared::maxColliders
    /// of each.
    void write(const FieldShape& field, const FrameSettings& settings, double time, double before,
               shared::Frame& frame) const;

    static VkDeviceSize bytes();

private:
    gpu::Buffer buffer_;
};

} // namespace sward::render
