#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "render/frame/frame.h"
#include "render/frame/frame_settings.h"
#include "shaders/shared/frame.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sward::render {

/// Mapped memory for a frame's tables, and its device address.
struct TablePlace {
    std::byte* mapped = nullptr; ///< tableBytes() bytes
    VkDeviceAddress address = 0;
};
VkDeviceSize tableBytes();

/// Writes a frame's colliders to `place`, and its colliders and its wind of `time` [s] into
/// `frame`, relative to `field`. At most shared::maxWindSources winds and shared::maxColliders
/// colliders.
void writeTables(TablePlace place, const FieldShape& field, const FrameSettings& settings,
                 std::span<const shared::Collider> colliders, double time, shared::Frame& frame);

/// A frame's table of colliders, in memory that the CPU writes and the device reads.
class FrameTables {
public:
    explicit FrameTables(const gpu::DeviceContext& context);

    /// Writes the table of `colliders`, and the frame's wind of `time` [s] and colliders into
    /// `frame`. At most shared::maxWindSources winds and shared::maxColliders colliders.
    void write(const FieldShape& field, const FrameSettings& settings,
               std::span<const shared::Collider> colliders, double time,
               shared::Frame& frame) const;

    static VkDeviceSize bytes();

private:
    gpu::Buffer buffer_;
};

} // namespace sward::render
