#pragma once

#include "gpu/context.h"
#include "gpu/timestamps.h"
#include "render/moving_blades.h"
#include "render/raster_pass.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Moves, culls and rasterises the live blades of a frame, as many at a time as the list holds.
/// Where blades hide others, those that frames have shown lately come first; what they hide is
/// left out of the rest.
struct RasterRounds {
    const gpu::DeviceContext& context;
    const MovingBlades& blades;
    RasterPass& raster;
    std::uint32_t rounds; ///< as many as the visible patches may need

    /// After MovingBlades::findVisiblePatches(), with all that is opaque in the visibility. `input`
    /// says whether blades hide others; then the frame describes the pyramid and culls by its own
    /// camera.
    void record(VkCommandBuffer commands, const RasterPass::Input& input,
                gpu::Timestamps* timestamps) const;

private:
    void recordFirst(VkCommandBuffer commands, const RasterPass::Input& input, std::uint32_t round,
                     gpu::Timestamps* timestamps) const;
    void recordPyramid(VkCommandBuffer commands, const RasterPass::Input& input,
                       gpu::Timestamps* timestamps) const;
};

} // namespace sward::render
