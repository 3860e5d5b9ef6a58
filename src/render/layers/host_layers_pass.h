#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/frame/placement.h"
#include "render/host/host_shadow_maps.h"
#include "render/host/host_view.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sward::render {

/// Writes the layers of hosts' views (HostLayers) from their visibility.
class HostLayersPass {
public:
    HostLayersPass(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
                   std::uint32_t slots, std::uint32_t maxViews);

    /// Specialisation of a pipeline.
    struct Variant {
        std::uint32_t samples = 1;
        bool hasHostLight = false; ///< see HostShadowMaps::isLit()
        auto operator<=>(const Variant&) const = default;
    };

    /// Writes what a view with HostLayers needs in a completed `slot`, after its HostShadowMaps.
    /// `placements`: of the instances, by their numbers.
    void prepare(const gpu::ShaderLibrary& shaders, std::uint32_t slot, std::uint32_t index,
                 const HostView& view, std::span<const Placement> placements);

    /// Makes a pipeline.
    const gpu::ComputePipeline& pipelineOf(const gpu::ShaderLibrary& shaders,
                                           const Variant& variant);

    /// Writes the layers. `push`: of the view. Needs barriers from compute shaders before, and to
    /// them after.
    void record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t index,
                shared::HostViewPush push) const;

private:
    struct View {
        gpu::Buffer table; ///< shared::LayersTable, then shared::LayersInstance of each instance
        const gpu::ComputePipeline* pipeline = nullptr;
    };

    const gpu::DeviceContext* context_;
    const HostShadowMaps* shadowMaps_;
    std::uint32_t maxViews_;
    std::map<Variant, gpu::ComputePipeline> pipelines_;
    std::vector<View> views_; ///< [slot][view]
};

/// Throws Error{usage} for layers of a frame's view that cannot be written.
void requireValid(const HostLayers& layers, std::size_t view, bool keepsMotion);

} // namespace sward::render
