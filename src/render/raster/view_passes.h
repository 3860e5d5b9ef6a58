#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/shader_library.h"
#include "render/frame/frame_settings.h"
#include "render/host/host_view.h"
#include "render/raster/raster_pass.h"
#include "render/resolve/host_lighting.h"
#include "render/resolve/shading_cache_pass.h"

#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace sward::render {

class HostShadowMaps;

/// The passes that rasterise and light hosts' views, with their pipelines.
class ViewPasses {
public:
    ViewPasses(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
               std::uint32_t slots, std::uint32_t maxViews);

    /// What the pipelines of a view depend on besides the view.
    struct Kind {
        std::span<const RasterPass::Variant> instances{}; ///< at least one
        const FrameSettings& settings;
        bool hasTwoPasses = false; ///< see ViewRaster::hasTwoPasses()
        bool hasLayer = false;     ///< an opaque layer, which makes the picture
        bool isLit = false;        ///< has light of the host's
        bool stores = false;       ///< into the view's picture
    };

    /// The pipelines of a view, which stay valid; RasterPass has further ones.
    struct Pipelines {
        const gpu::ComputePipeline* seed = nullptr;     ///< null: the visibility starts cleared
        const gpu::ComputePipeline* cache = nullptr;    ///< of the shading cache; null: none
        const gpu::ComputePipeline* lighting = nullptr; ///< null: a layer makes the picture
    };

    /// Makes the pipelines of a view on first use.
    Pipelines prepare(const gpu::ShaderLibrary& shaders, const HostView& view, const Kind& kind);

    const RasterPass& raster() const { return raster_; }
    HostLighting& lighting() { return lighting_; }

private:
    const gpu::ComputePipeline* seedOf(const gpu::ShaderLibrary& shaders, const HostView& view);

    const gpu::DeviceContext* context_;
    RasterPass raster_;
    ShadingCachePass shadingCache_;
    HostLighting lighting_;
    gpu::ImageSetLayout imageLayout_; ///< compatible with PyramidPass
    std::map<std::pair<std::uint32_t, bool>, gpu::ComputePipeline> seeds_; ///< reversed: true
};

} // namespace sward::render
