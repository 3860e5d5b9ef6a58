#pragma once

#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "render/collider_pass.h"
#include "render/ground_buffers.h"
#include "render/ground_cull_pass.h"
#include "render/ground_pass.h"
#include "render/target_settings.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>

namespace sward::render {

/// Draws what is opaque among the grass, the ground and the colliders, by the graphics pipeline.
class OpaquePass {
public:
    /// `ground` outlives it.
    OpaquePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, const GroundBuffers& ground);

    /// Makes ready for a frame with so many colliders, in the colours of the wind or in its own.
    void prepare(const gpu::ShaderLibrary& shaders, std::uint32_t colliders, bool paintsWind);

    /// Outside of a rendering, before the following: see GroundCullPass::record().
    void recordCull(VkCommandBuffer commands, VkDeviceAddress frame) const;

    /// Inside a rendering.
    void record(VkCommandBuffer commands, VkDeviceAddress frame) const;

    VkDeviceSize bytes() const { return cull_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    const GroundBuffers* ground_;
    TargetSettings target_;
    GroundCullPass cull_;
    GroundPass plain_;
    std::unique_ptr<GroundPass> windy_;       ///< once somebody has asked for it
    std::unique_ptr<ColliderPass> colliders_; ///< once there have been any
    std::uint32_t colliderCount_ = 0;
    bool paintsWind_ = false;
};

} // namespace sward::render
