#pragma once

#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "render/field_buffers.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>
#include <map>

namespace sward::render {

/// Moves the blades of the live patches, judges them, and lists those that are to be drawn.
class UpdateCullPass {
public:
    explicit UpdateCullPass(const gpu::DeviceContext& context);

    /// What the shader is made for.
    struct Variant {
        std::uint32_t windCounts = 0; ///< shared::Wind::counts
        bool hasColliders = false;
        auto operator<=>(const Variant&) const = default;
    };

    /// Makes the pipeline for a frame unless there is one.
    void prepare(const gpu::ShaderLibrary& shaders, Variant variant);

    enum class Scope {
        visible, ///< the live patches of the walk recorded before; judge and count
        all,     ///< every patch; move only
    };

    /// Between a barrier from the clearing of the counts, or from the walk, and one to the draw.
    /// `variant` has been prepared.
    void record(VkCommandBuffer commands, const FieldBuffers& field, VkDeviceAddress frame,
                Variant variant, Scope scope, std::uint32_t round = 0) const;

private:
    const gpu::DeviceContext* context_;
    std::map<Variant, gpu::ComputePipeline> pipelines_;
};

} // namespace sward::render
