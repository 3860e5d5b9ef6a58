#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/cull/moving_blades.h"
#include "render/field/visibility_history.h"
#include "render/frame/frame_place.h"
#include "render/raster/raster_pass.h"
#include "render/raster/raster_rounds.h"
#include "render/resolve/shading_cache.h"
#include "render/resolve/shading_cache_pass.h"
#include "render/resolve/target_settings.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>

namespace sward::render {

/// Why blades cannot be rasterised by compute shaders on a device into targets of a format; null if
/// they can.
const char* obstacleToRaster(const gpu::DeviceContext& context, VkFormat colorFormat);

/// The viewer's only view for the rasteriser: one field, over a ground in the same visibility
/// buffer.
class ViewerRaster {
public:
    /// `obstacleToRaster()` must return null.
    ViewerRaster(const gpu::DeviceContext& context, const TargetSettings& target,
                 std::uint32_t bladeCount);

    /// Makes the pipelines for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    /// Resizes the pictures; the device must be done with the former ones.
    void resize(VkExtent2D size);

    /// Makes room for `blades` places of blades. `outgrown` gets what is replaced.
    void expectBlades(std::uint32_t blades, OutgrownBuffers& outgrown);

    /// Common inputs of the functions below.
    struct Input {
        const FieldBuffers* field = nullptr;
        FramePlace frame{};           ///< of the picture
        FramePlace cullView{};        ///< whose camera listed the visible blades
        std::uint32_t firstBlade = 1; ///< see OpaqueRasterPass
        bool hasTwoPasses = false;    ///< blades hide blades: see shared::RasterPush::history
    };

    /// Clears lists of blades, and the visibility unless the frame before left it empty. Needs
    /// barriers from all accesses to fills before, and from fills to dispatches after.
    void recordBegin(const gpu::Recording& commands);

    /// Fills the whole depth pyramid from what is opaque. Barriers from and to compute shaders.
    void recordDepths(const gpu::Recording& commands, const Input& input) const;

    /// Moves, culls and rasterises the visible patches in `rounds` rounds.
    void recordRounds(const gpu::Recording& commands, const Input& input,
                      const MovingBlades& blades, std::uint32_t rounds,
                      gpu::Timestamps* timestamps) const;

    /// Push constants, except tiles, for shaders that write or read the visibility.
    shared::RasterPush pushFor(const Input& input) const;

    VkDeviceAddress visibility() const { return visibility_.address(); }
    VkDeviceSize bytes() const;

private:
    RasterPass::Variant variant() const;
    RasterPass::View viewOf(const RasterPass::Instance& instance) const;
    RasterPass::Instance instanceOf(const Input& input) const;

    const gpu::DeviceContext* context_;
    TargetSettings target_;
    RasterPass pass_;
    ShadingCachePass shadingPass_;
    LargeBladeList large_;
    VisibilityHistory history_;
    std::optional<ShadingCache> shadingCache_; ///< for large blades, if work-groups draw them
    const gpu::ComputePipeline* cachePipeline_ = nullptr; ///< of the prepared frame, if any

    glm::uvec2 size_{0};
    bool isEmpty_ = false; ///< the visibility is empty when a frame begins
    gpu::Buffer visibility_;
};

} // namespace sward::render
