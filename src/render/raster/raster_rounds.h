#pragma once

#include "gpu/context/context.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/raster/raster_pass.h"
#include "render/resolve/shading_cache_pass.h"

#include <cstdint>
#include <functional>

namespace sward::render {

/// Rasterises a view's lists of blades, one list's length per round. With two passes, blades in the
/// visibility history are drawn first; hidden blades among the others are not drawn.
struct RasterRounds {
    const gpu::DeviceContext& context;
    const RasterPass& pass;
    const RasterPass::View& view;
    bool hasTwoPasses = false;
    const gpu::ComputePipeline* shadingCache = nullptr; ///< of ShadingCachePass; null: no cache
    std::uint32_t rounds = 1;
    std::function<void(std::uint32_t round)> list{}; ///< fills the lists; unset: they are full

    /// Records the rounds, with barriers between them. Needs a barrier from the lists before, and
    /// to readers of the visibility after. `timestamps` may be null.
    void record(const gpu::Recording& commands, gpu::Timestamps* timestamps) const;

private:
    void recordFirst(const gpu::Recording& commands, std::uint32_t round,
                     gpu::Timestamps* timestamps) const;
    void recordEarlyLarge(const gpu::Recording& commands, gpu::Timestamps* timestamps) const;
};

} // namespace sward::render
