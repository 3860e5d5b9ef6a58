#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/frame_place.h"
#include "render/target_settings.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <map>

namespace sward::render {

/// Caches shading inputs of large blades between their early pass and the resolve. Reason: many
/// pixels show each of them and would compute the same inputs.
class ShadingCachePass {
public:
    ShadingCachePass(const gpu::DeviceContext& context, const TargetSettings& target);

    /// Makes the pipeline for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    void describe(shared::RasterPush& push) const; ///< addresses of the cache

    /// Needs a barrier from the listing of large blades for their early pass before, and one to the
    /// resolve after. `groups` begins with a VkDispatchIndirectCommand.
    void record(const gpu::Recording& commands, const shared::RasterPush& push,
                const FramePlace& frame, VkBuffer groups) const;

    VkDeviceSize bytes() const { return places_.bytes() + shadingCache_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    TargetSettings target_;
    gpu::UniformSetLayout frameLayout_;
    std::map<Shading, gpu::ComputePipeline> pipelines_;
    Shading shading_{}; ///< of the prepared frame
    gpu::Buffer places_;
    gpu::Buffer shadingCache_;
};

} // namespace sward::render
