#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "render/tessellation/blade_target.h"

#include <optional>

namespace sward::render {

/// The pipelines that draw blades into a host's target.
struct BladeTarget::Parts {
    Parts(const gpu::DeviceContext& context, const HostTarget& target);

    gpu::GraphicsPipeline tessellated;

    /// The same in a host's light (HostShadowMaps); null in a target without colours.
    gpu::GraphicsPipeline hostLight;

    /// Draws the compute rasteriser's visibility; none if the device or the sample count does not
    /// support it.
    std::optional<gpu::GraphicsPipeline> visibility;
};

} // namespace sward::render
