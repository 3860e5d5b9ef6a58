#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/frame/frame_place.h"
#include "render/resolve/target_settings.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <map>

namespace sward::render {

/// Fills a ShadingCache.
class ShadingCachePass {
public:
    explicit ShadingCachePass(const gpu::DeviceContext& context);

    /// Specialisation of the shader.
    struct Variant {
        std::uint32_t samples = 1;
        Shading shading{};
        FieldLooks looks{};
        auto operator<=>(const Variant&) const = default;
    };

    /// The pipeline of a variant, which stays valid. Makes it on first use.
    const gpu::ComputePipeline& prepare(const gpu::ShaderLibrary& shaders, const Variant& variant);

    /// Stores the listed large blades into the cache that `push` describes. `groups`: arguments of
    /// an indirect dispatch.
    static void record(const gpu::Recording& commands, const gpu::ComputePipeline& pipeline,
                       const shared::RasterPush& push, const FramePlace& frame, VkBuffer groups);

private:
    const gpu::DeviceContext* context_;
    gpu::UniformSetLayout frameLayout_;
    std::map<Variant, gpu::ComputePipeline> pipelines_;
};

} // namespace sward::render
