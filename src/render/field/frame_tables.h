#pragma once

#include "render/frame/frame.h"
#include "render/frame/frame_settings.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>

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

} // namespace sward::render
