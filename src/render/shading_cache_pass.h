#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "gpu/uniform_sets.h"
#include "render/frame_place.h"
#include "render/target_settings.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <map>

namespace sward::render {

/// Keeps what shading asks of large blades from their early pass to the resolve: each of them is
/// shown by many pixels, which would otherwise all find the same anew.
class ShadingCachePass {
public:
    ShadingCachePass(const gpu::DeviceContext& context, const TargetSettings& target);

    /// Makes ready for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    void describe(shared::RasterPush& push) const; ///< where shaders find it

    /// Between a barrier from those who list large blades for their early pass and one to the
    /// resolve; `groups` begins with a VkDispatchIndirectCommand.
    void record(VkCommandBuffer commands, const shared::RasterPush& push, const FramePlace& frame,
                VkBuffer groups) const;

    VkDeviceSize bytes() const { return places_.bytes() + shadingCache_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    TargetSettings target_;
    gpu::UniformSetLayout frameLayout_;
    std::map<Shading, gpu::ComputePipeline> pipelines_;
    Shading shading_{}; ///< of the frame prepared last
    gpu::Buffer places_;
    gpu::Buffer shadingCache_;
};

} // namespace sward::render
