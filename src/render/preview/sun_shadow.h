#pragma once

#include "core/bounds.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/image.h"
#include "gpu/shader_library.h"
#include "render/preview/ground_buffers.h"
#include "shaders/shared/frame.h"

#include <glm/vec3.hpp>

namespace sward::render {

/// Width and height of the map [pixels].
constexpr std::uint32_t sunShadowSize = 2048;

/// View of a map of `size` × `size` pixels from the sun that contains the box `ground`. Zero for an
/// empty box. The table is unset.
shared::SunShadow sunShadowOf(const Aabb& ground, glm::vec3 sunDirection, std::uint32_t size);

/// The shadow map of the ground, redrawn when the sun has moved; in frames with colliders it
/// includes them.
class SunShadowPass {
public:
    /// `ground` is the box of shadow casters, relative to the field's origin.
    SunShadowPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                  const Aabb& ground);

    /// Call after the frame's sun and colliders are set.
    void describe(shared::Frame& frame);

    /// Makes the pipelines for the frame described last, on first use.
    void prepare(const gpu::ShaderLibrary& shaders);

    /// Draws the map for the frame described last, unless current; outside of a rendering.
    void record(VkCommandBuffer commands, const GroundBuffers& ground, VkDeviceAddress frame);

    VkDeviceSize bytes() const { return map_.memoryBytes() + depths_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    Aabb ground_;
    glm::vec3 sun_{0.0f};             ///< in the frame described last
    glm::vec3 drawn_{0.0f};           ///< of the current map
    std::uint32_t colliderCount_ = 0; ///< in the frame described last
    bool hasColliders_ = false;       ///< whether the current map shows colliders
    gpu::Image map_;
    gpu::Buffer depths_; ///< the same, accessed by address
    gpu::GraphicsPipeline pipeline_;
    gpu::GraphicsPipeline colliders_; ///< made for the first collider
};

} // namespace sward::render
