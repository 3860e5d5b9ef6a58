#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/frame/frame_place.h"
#include "render/preview/ground_buffers.h"
#include "render/resolve/target_settings.h"
#include "render/resolve/tile_classification.h"
#include "shaders/shared/opaque.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <vector>

namespace sward::render {

/// Draws the opaque scene, ground and colliders, by compute shaders: into a visibility buffer
/// (shared::VisibilityArray); then lights the visible part of it.
class OpaqueRasterPass {
public:
    /// `ground` must outlive it; the device must have 64-bit atomics.
    OpaqueRasterPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                     const GroundBuffers& ground, const TargetSettings& target);

    /// Makes a frame's pipelines. `colliders`: count; `debugMode`: see knownDebugMode().
    void prepare(const gpu::ShaderLibrary& shaders, std::uint32_t colliders,
                 std::uint32_t debugMode);

    /// Resizes the pictures; the device must be done with the former ones.
    void resize(VkExtent2D size);

    /// The visibility's number of the frame's first blade; lower numbers are the sky and triangles.
    std::uint32_t firstBlade() const;

    /// Clears lists of triangles. Needs barriers from all accesses to fills before, and from fills
    /// to dispatches after.
    void recordBegin(const gpu::Recording& commands) const;

    /// Draws into a cleared visibility. Needs a barrier to compute shaders after.
    void recordTriangles(const gpu::Recording& commands, const FramePlace& frame,
                         VkDeviceAddress visibility) const;

    /// Lights what the visibility shows. Needs barriers from and to compute shaders; lit() is then
    /// in ImageUse::storage. `tiles`: classified tiles if the target sorts tiles, else null.
    void recordLight(const gpu::Recording& commands, const FramePlace& frame,
                     VkDeviceAddress visibility, const TileClassification* tiles) const;

    /// Linear; alpha: see softness() of lighting.glsl. Per pixel, the sum over the samples that
    /// show something opaque, divided by all samples. Other pixels are undefined.
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
    gpu::ComputePipeline colliders_; ///< made for the first collider
    gpu::ComputePipeline middle_;
    gpu::ComputePipeline large_;
    std::map<std::uint32_t, gpu::ComputePipeline> light_; ///< by debug mode
    gpu::Buffer work_;                                    ///< shared::OpaqueWork
    gpu::Buffer middleTriangles_;                         ///< indices of triangles
    gpu::Buffer largeTriangles_;                          ///< shared::LargeTriangle
    std::uint32_t colliderTriangles_ = 0;                 ///< in the prepared frame
    std::uint32_t debugMode_ = shared::debugAsTold;       ///< of the prepared frame

    VkExtent2D size_{};
    gpu::Image lit_;
    std::vector<gpu::ImageSet> images_; ///< shared::imagesTogether in each
};

} // namespace sward::render
