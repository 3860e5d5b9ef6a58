#pragma once

#include "gpu/context/context.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/cull/moving_blades.h"
#include "render/raster/raster_pass.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Moves, culls and rasterises the visible patches of a frame, one list's length per round. With
/// the occlusion test, blades in the visibility history are drawn first; hidden blades among the
/// rest are dropped.
struct RasterRounds {
    const gpu::DeviceContext& context;
    const MovingBlades& blades;
    RasterPass& raster;
    std::uint32_t rounds; ///< upper bound for the visible patches

    /// Call after MovingBlades::findVisiblePatches(), with the opaque scene in the visibility. If
    /// `input` enables the occlusion test, the frame describes the pyramid and its own camera
    /// culls.
    void record(const gpu::Recording& commands, const RasterPass::Input& input,
                gpu::Timestamps* timestamps) const;

private:
    void recordFirst(const gpu::Recording& commands, const RasterPass::Input& input,
                     std::uint32_t round, gpu::Timestamps* timestamps) const;
    void recordPyramid(const gpu::Recording& commands, const RasterPass::Input& input,
                       gpu::Timestamps* timestamps) const;
};

} // namespace sward::render
