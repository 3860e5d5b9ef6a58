#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/cull/field_buffers.h"
#include "render/frame_place.h"
#include "render/raster/large_blade_list.h"
#include "render/resolve/shading_cache_pass.h"
#include "render/target_settings.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <optional>

namespace sward::render {

/// Why blades cannot be rasterised by compute shaders on a device into targets of a format; null if
/// they can.
const char* obstacleToRaster(const gpu::DeviceContext& context, VkFormat colorFormat);

/// Rasterises blades by compute shaders into a visibility buffer that already holds the opaque
/// scene. ResolvePass makes the picture.
class RasterPass {
public:
    /// `obstacleToRaster()` must return null.
    RasterPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, std::uint32_t bladeCount);

    /// Makes the pipelines for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    /// Resizes the pictures; the device must be done with the former ones.
    void resize(VkExtent2D size);

    /// Makes room for `blades` places of blades. `outgrown` gets what is
    /// replaced.
    void expectBlades(std::uint32_t blades, OutgrownBuffers& outgrown);

    /// Common inputs of the functions below.
    struct Input {
        const FieldBuffers* field = nullptr;
        FramePlace frame{};           ///< of the picture
        FramePlace cullView{};        ///< whose camera listed the visible blades
        std::uint32_t firstBlade = 1; ///< see OpaqueRasterPass
        bool findsHidden = false;     ///< blades occlude blades: see shared::RasterPush::seen
    };

    /// Clears lists of blades, and the visibility unless the frame before left it empty. Needs
    /// barriers from all accesses to fills before, and from fills to dispatches after.
    void recordBegin(const gpu::Recording& commands);

    /// Early: blades drawn without occlusion test. Late: blades tested against the depth pyramid.
    enum class Phase { early, late };

    /// Rasterises the blades that a round of the update has listed, except large ones. Needs
    /// barriers from and to compute shaders.
    void recordBlades(const gpu::Recording& commands, const Input& input, std::uint32_t round,
                      Phase phase) const;

    /// Rasterises the listed large blades. With the occlusion test the early pass draws the
    /// quarters in the visibility history, and fills the shading cache. The late pass tests the
    /// remaining segments against the depth pyramid and draws the visible ones. Barriers as above.
    void recordLarge(const gpu::Recording& commands, const Input& input, Phase phase) const;

    /// Pyramid levels to fill; all of them once a frame.
    enum class Levels { finest, all };

    /// Fills levels of the frame's depth pyramid from the current visibility. Blades listed later
    /// are drawn in the late pass. Barriers as above.
    void recordDepths(const gpu::Recording& commands, const Input& input, Levels levels) const;

    /// Push constants, except tiles, for shaders that write or read the visibility.
    shared::RasterPush pushFor(const Input& input) const;

    VkDeviceAddress visibility() const { return visibility_.address(); }
    UpdateCullPass::Shown shown() const { return largeList_.shown(); }
    VkDeviceSize bytes() const;

private:
    const gpu::DeviceContext* context_;
    TargetSettings target_;
    gpu::UniformSetLayout frameLayout_;
    gpu::ComputePipeline blades_;
    gpu::ComputePipeline large_;
    gpu::ComputePipeline cut_; ///< blades cut by the near plane
    gpu::ComputePipeline lateBlades_;
    gpu::ComputePipeline lateLarge_; ///< culls hidden quarters
    gpu::ComputePipeline depths_;
    gpu::ComputePipeline allDepths_;
    std::optional<ShadingCachePass> shadingCache_; ///< for large blades, if work-groups draw them

    VkExtent2D size_{};
    bool isEmpty_ = false; ///< the visibility is empty when a frame begins
    gpu::Buffer visibility_;
    LargeBladeList largeList_;
};

} // namespace sward::render
