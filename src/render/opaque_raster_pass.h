#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/image_set.h"
#include "gpu/shader_library.h"
#include "gpu/uniform_sets.h"
#include "render/frame_place.h"
#include "render/ground_buffers.h"
#include "render/target_settings.h"
#include "render/tile_classification.h"
#include "shaders/shared/opaque.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <vector>

namespace sward::render {

/// Draws what is opaque among the grass, the ground and the colliders, by compute shaders: into a
/// visibility (shared::VisibilityArray), and later the light of what is still seen of it.
class OpaqueRasterPass {
public:
    /// `ground` outlives it; the device has 64-bit atomics.
    OpaqueRasterPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                     const GroundBuffers& ground, const TargetSettings& target);

    /// Makes ready for a frame with so many colliders; `debugMode` as knownDebugMode() has it.
    void prepare(const gpu::ShaderLibrary& shaders, std::uint32_t colliders,
                 std::uint32_t debugMode);

    /// Has pictures of this size; the device is done with the former ones.
    void resize(VkExtent2D size);

    /// What the visibility has for the first blade of the frame: the sky and all triangles come
    /// before it.
    std::uint32_t firstBlade() const;

    /// Empties lists of triangles, between barriers from anything to fills, and from those to
    /// dispatches.
    void recordBegin(VkCommandBuffer commands) const;

    /// Into a visibility that nothing has been drawn into; then comes a barrier to compute shaders.
    void recordTriangles(VkCommandBuffer commands, const FramePlace& frame,
                         VkDeviceAddress visibility) const;

    /// Lights what the visibility shows; between barriers from and to compute shaders. lit() is
    /// then in ImageUse::storage. `tiles` have been sorted if the target asks for that, or are
    /// null.
    void recordLight(VkCommandBuffer commands, const FramePlace& frame, VkDeviceAddress visibility,
                     const TileClassification* tiles) const;

    /// Linear; alpha: see softness() of lighting.glsl. Per pixel the sum over the samples that see
    /// something opaque, over all samples; of other pixels it holds nothing of use.
    const gpu::Image& lit() const { return lit_; }
    VkDeviceSize bytes() const;

private:
    gpu::ComputePipeline pipeline(const gpu::ShaderLibrary& shaders, const char* name,
                                  const char* shader,
                                  std::vector<gpu::SpecializationConstant> constants = {}) const;
    shared::OpaquePush pushFor(const FramePlace& frame, VkDeviceAddress visibility) const;

    const gpu::DeviceContext* context_;
    const GroundBuffers* ground_;
    TargetSettings target_;
    gpu::ImageSetLayout imageLayout_;
    gpu::UniformSetLayout frameLayout_;
    gpu::ComputePipeline triangles_;
    gpu::ComputePipeline colliders_; ///< once there have been any
    gpu::ComputePipeline middle_;
    gpu::ComputePipeline large_;
    std::map<std::uint32_t, gpu::ComputePipeline> light_; ///< by the debug mode they know
    gpu::Buffer work_;                                    ///< shared::OpaqueWork
    gpu::Buffer middleTriangles_;                         ///< their numbers
    gpu::Buffer largeTriangles_;                          ///< shared::LargeTriangle
    std::uint32_t colliderTriangles_ = 0;                 ///< of the frame prepared last
    std::uint32_t debugMode_ = shared::debugAsTold;       ///< likewise

    VkExtent2D size_{};
    gpu::Image lit_;
    std::vector<gpu::ImageSet> images_; ///< shared::imagesTogether each
};

} // namespace sward::render
