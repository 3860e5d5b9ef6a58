#pragma once

#include "gpu/context.h"
#include "gpu/graphics_pipeline.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::render {

/// What a host draws blades into: its own rendering scope, by dynamic rendering or by a render
/// pass.
struct HostTarget {
    /// Of the scope's colour attachments: blades are drawn into the first, their motion into the
    /// second if `writesMotion`, and others are left alone (then the device has
    /// `independentBlend`). None: a shadow's map, or depth beforehand.
    std::vector<VkFormat> colorFormats{};

    /// Two channels: where a point was in the frame before, minus where it is, in widths and
    /// heights of the picture, y downwards. Asks for Grass::Settings::keepsMotion.
    bool writesMotion = false;
    VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;  ///< of the scope's depth attachment
    VkFormat stencilFormat = VK_FORMAT_UNDEFINED; ///< of its stencil attachment; it is left alone
    std::uint32_t samples = 1;                    ///< 1, 2, 4 or 8
    bool hasReversedZ = true;                     ///< as in the views that are drawn into it
    bool keepsRadiance = false;                   ///< linear radiance; else developed for a screen
    VkRenderPass renderPass = VK_NULL_HANDLE; ///< or any compatible one; null: dynamic rendering
    std::uint32_t subpass = 0;                ///< of the render pass
};

/// The pipelines that draw blades into such targets.
class BladeTarget {
public:
    /// Makes it; throws Error{runtime} or Error{unsupported} where the device cannot. Destroyed
    /// after the commands that draw with it.
    BladeTarget(const gpu::DeviceContext& context, const HostTarget& target);

    /// Of the tessellator.
    const gpu::GraphicsPipeline& pipeline() const { return pipeline_; }

    /// Of what the compute rasteriser has made visible; null where the device or the number of
    /// samples does not allow it.
    const gpu::GraphicsPipeline* visibilityPipeline() const
    {
        return visibility_ ? &*visibility_ : nullptr;
    }

    const HostTarget& settings() const { return settings_; } ///< that it was made for

private:
    HostTarget settings_;
    gpu::GraphicsPipeline pipeline_;
    std::optional<gpu::GraphicsPipeline> visibility_;
};

} // namespace sward::render
