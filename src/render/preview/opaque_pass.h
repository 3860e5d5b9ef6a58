#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/preview/collider_pass.h"
#include "render/preview/ground_buffers.h"
#include "render/preview/ground_cull_pass.h"
#include "render/preview/ground_pass.h"
#include "render/resolve/target_settings.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>

namespace sward::render {

/// Draws the opaque scene, ground and colliders, by the graphics pipeline.
class OpaquePass {
public:
    /// `ground` outlives it.
    OpaquePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, const GroundBuffers& ground);

    /// Makes the pipelines for a frame with `colliders` colliders, with or without wind colours.
    void prepare(const gpu::ShaderLibrary& shaders, std::uint32_t colliders, bool paintsWind);

    /// Outside of a rendering, before record(): see GroundCullPass::record().
    void recordCull(const gpu::Recording& commands, VkDeviceAddress frame) const;

    /// Inside a rendering.
    void record(const gpu::Recording& commands, VkDeviceAddress frame) const;

    VkDeviceSize bytes() const { return cull_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    const GroundBuffers* ground_;
    TargetSettings target_;
    GroundCullPass cull_;
    GroundPass plain_;
    std::unique_ptr<GroundPass> windy_;       ///< made on first use
    std::unique_ptr<ColliderPass> colliders_; ///< made for the first collider
    std::uint32_t colliderCount_ = 0;
    bool paintsWind_ = false;
};

} // namespace sward::render
