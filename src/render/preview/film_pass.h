#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/sampler.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/resolve/target_settings.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

namespace sward::render {

/// Reconstruction filter: makes the target's picture from multisampled colour of the graphics
/// pipeline, softer where grass is finer than pixels.
class FilmPass {
public:
    FilmPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
             const TargetSettings& target);

    /// Call when the picture size has changed and the device is done with the old pictures.
    void resize(glm::uvec2 size);

    /// The resolve target of the samples: colour, and 1 − softness (lighting.glsl) as alpha.
    VkImageView begin(const gpu::Recording& commands) const;

    /// Draws into a target of that size in ImageUse::colorTarget, after the resolve of the samples.
    void record(const gpu::Recording& commands, VkImageView target) const;

private:
    const gpu::DeviceContext* context_;
    VkFormat format_;
    gpu::ImageSetLayout imageLayout_;
    gpu::Sampler sampler_;
    gpu::GraphicsPipeline pipeline_;
    gpu::Image resolved_;
    gpu::ImageSet images_;
};

} // namespace sward::render
