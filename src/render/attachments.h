#pragma once

#include "gpu/context.h"
#include "gpu/image.h"
#include "render/target_settings.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

namespace sward::render {

/// The pictures that a frame needs beside its target: depth, and colour with several samples.
class Attachments {
public:
    /// Throws Error{unsupported} if the device does not draw with so many samples.
    Attachments(const gpu::DeviceContext& context, const TargetSettings& settings);

    /// Has pictures of this size; whether they are new. Then it has waited until the device was
    /// done with the old ones.
    bool resize(glm::uvec2 size);

    /// Whether there is a colour of its own, which is not the target.
    bool hasColor() const { return settings_.samples > 1; }
    const gpu::Image& depth() const { return depth_; }
    const gpu::Image& color() const { return color_; } ///< only if hasColor()
    VkDeviceSize bytes() const { return depth_.memoryBytes() + color_.memoryBytes(); }

private:
    const gpu::DeviceContext* context_;
    TargetSettings settings_;
    glm::uvec2 size_{0};
    gpu::Image depth_;
    gpu::Image color_;
};

} // namespace sward::render
