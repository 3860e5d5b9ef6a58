#pragma once

#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "gpu/timestamps.h"
#include "render/blade_pass.h"
#include "render/field_buffers.h"
#include "render/film_pass.h"
#include "render/sky_pass.h"
#include "render/target_settings.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <optional>

namespace sward::render {

/// What the graphics pipeline draws after the ground where it draws the blades, too: these, the
/// sky, and the picture of all samples.
class TessellatedPass {
public:
    TessellatedPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                    const TargetSettings& target);

    /// To be called when the pictures have a new size and the device is done with the old ones.
    void resize(glm::uvec2 size);

    /// Makes ready for a frame in the colours of the wind or in its own.
    void prepare(const gpu::ShaderLibrary& shaders, bool paintsWind);

    /// What the samples of the rendering are to be resolved into; null where a pixel has one
    /// sample.
    VkImageView begin(VkCommandBuffer commands) const;

    /// Inside a rendering on top of the ground.
    void record(VkCommandBuffer commands, const FieldBuffers& field, VkDeviceAddress frame,
                gpu::Timestamps* timestamps) const;

    /// After the rendering: several samples become the target's picture.
    void finish(VkCommandBuffer commands, VkImageView target) const;

private:
    const gpu::DeviceContext* context_;
    TargetSettings target_;
    BladePass blades_;
    SkyPass sky_;
    std::optional<BladePass> windy_; ///< once somebody has asked for it
    std::optional<FilmPass> film_;   ///< of several samples
    bool paintsWind_ = false;
};

} // namespace sward::render
