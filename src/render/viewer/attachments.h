#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "render/resolve/target_settings.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

namespace sward::render {

/// Images that a frame needs beside its target: depth, and multisampled colour.
class Attachments {
public:
    /// Throws Error{unsupported} if the device does not support the sample count.
    Attachments(const gpu::DeviceContext& context, const TargetSettings& settings);

    /// Resizes the images. Returns whether they are new; then it has waited for the device to
    /// finish with the old ones.
    bool resize(glm::uvec2 size);

    /// Whether there is a multisampled colour image besides the target.
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
