#pragma once

#include "core/bounds.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/image.h"
#include "gpu/shader_library.h"
#include "render/ground_buffers.h"
#include "shaders/shared/frame.h"

#include <glm/vec3.hpp>

namespace sward::render {

/// Pixels along an edge of the map.
constexpr std::uint32_t sunShadowSize = 2048;

/// How a map of `size` pixels looks at `ground` from the sun: it holds the whole box. Nothing of it
/// for an empty box. The table is left out.
shared::SunShadow sunShadowOf(const Aabb& ground, glm::vec3 sunDirection, std::uint32_t size);

/// The shadow of the ground: drawn once, and again when the sun has moved; with those of colliders
/// where there are any.
class SunShadowPass {
public:
    /// `ground` is the box of what casts shadows, relative to the field's origin.
    SunShadowPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                  const Aabb& ground);

    /// After the frame's sun is known, and its colliders.
    void describe(shared::Frame& frame);

    /// Makes the pipelines of the frame described last unless they are there.
    void prepare(const gpu::ShaderLibrary& shaders);

    /// Draws the map for the frame described last, unless it is there; outside a rendering.
    void record(VkCommandBuffer commands, const GroundBuffers& ground, VkDeviceAddress frame);

    VkDeviceSize bytes() const { return map_.memoryBytes() + depths_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    Aabb ground_;
    glm::vec3 sun_{0.0f};             ///< of the frame described last
    glm::vec3 drawn_{0.0f};           ///< of the map that is there
    std::uint32_t colliderCount_ = 0; ///< of the frame described last
    bool hasColliders_ = false;       ///< whether the map that is there shows some
    gpu::Image map_;
    gpu::Buffer depths_; ///< the same where shaders read it by address
    gpu::GraphicsPipeline pipeline_;
    gpu::GraphicsPipeline colliders_; ///< once there have been any
};

} // namespace sward::render
