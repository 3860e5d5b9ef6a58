#pragma once

#include "core/bounds.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/preview/ground_buffers.h"
#include "render/preview/shadow_contents.h"
#include "shaders/shared/frame.h"

#include <glm/vec3.hpp>

#include <span>

namespace sward::render {

/// Width and height of the map [pixels].
constexpr std::uint32_t sunShadowSize = 2048;

/// View of a map of `size` × `size` pixels from the sun that contains the box `ground`. Zero for an
/// empty box. The table is unset.
shared::SunShadow sunShadowOf(const Aabb& ground, glm::vec3 sunDirection, std::uint32_t size);

/// The shadow map of ground and colliders. The ground is redrawn when the sun has moved; around
/// colliders that have changed it is copied, and they are drawn into it. The copy takes as much
/// memory as the map, from the first collider on; without it the ground is redrawn whenever a
/// collider changes.
class SunShadowPass {
public:
    /// `ground` is the box of shadow casters, relative to the field's origin. `keepsGround`: with
    /// the copy.
    SunShadowPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                  const Aabb& ground, bool keepsGround);

    /// Call after the frame's sun is set. `colliders` are those of the frame's table.
    void describe(shared::Frame& frame, std::span<const shared::Collider> colliders);

    /// Makes the pipelines for the frame described last, on first use.
    void prepare(const gpu::ShaderLibrary& shaders);

    /// Draws what has changed since the frame described last before; outside of a rendering.
    void record(const gpu::Recording& commands, const GroundBuffers& ground, VkDeviceAddress frame);

    VkDeviceSize bytes() const
    {
        return map_.memoryBytes() + groundMap_.memoryBytes() + depths_.bytes();
    }

private:
    void drawGround(const gpu::Recording& commands, const GroundBuffers& ground,
                    VkDeviceAddress frame);
    void drawColliders(const gpu::Recording& commands, VkDeviceAddress frame);

    const gpu::DeviceContext* context_;
    Aabb ground_;
    bool keepsGround_;
    ShadowContents contents_;
    ShadowChanges changes_; ///< not recorded yet
    gpu::Image map_;
    gpu::Image groundMap_;      ///< without colliders; made for the first
    bool hasGroundMap_ = false; ///< it is current
    gpu::Buffer depths_;        ///< the same, accessed by address
    gpu::GraphicsPipeline pipeline_;
    gpu::GraphicsPipeline colliders_; ///< made for the first collider
};

} // namespace sward::render
