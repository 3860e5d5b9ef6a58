#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "gpu/uniform_sets.h"
#include "render/field_buffers.h"
#include "render/frame_place.h"
#include "render/large_blade_list.h"
#include "render/shading_cache_pass.h"
#include "render/target_settings.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <optional>

namespace sward::render {

/// Why blades cannot be rasterised by compute shaders on a device into targets of a format; null if
/// they can.
const char* obstacleToRaster(const gpu::DeviceContext& context, VkFormat colorFormat);

/// Draws blades by compute shaders: those that are seen into a visibility buffer, which holds what
/// is opaque already. ResolvePass makes the picture of both.
class RasterPass {
public:
    /// `obstacleToRaster()` has none.
    RasterPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, std::uint32_t bladeCount);

    /// Makes ready for a frame.
    void prepare(const gpu::ShaderLibrary& shaders, Shading shading);

    /// Has pictures of this size; the device is done with the former ones.
    void resize(VkExtent2D size);

    /// What each of the following reads.
    struct Input {
        const FieldBuffers* field = nullptr;
        FramePlace frame{};           ///< of the picture
        FramePlace cullView{};        ///< by whose camera the visible blades were listed
        std::uint32_t firstBlade = 1; ///< see OpaqueRasterPass
        bool findsHidden = false;     ///< whether blades hide others: see shared::RasterPush::seen
    };

    /// Empties lists of blades, and the visibility unless the frame before has left it empty;
    /// between barriers from anything to fills, and from those to dispatches.
    void recordBegin(VkCommandBuffer commands);

    /// Blades that are drawn without a question, or those of which the frame's pyramid hides some.
    enum class Phase { early, late };

    /// Rasterises the visible blades that a round of the update has listed, but for large ones.
    /// Between barriers from compute shaders to the same.
    void recordBlades(VkCommandBuffer commands, const Input& input, std::uint32_t round,
                      Phase phase) const;

    /// Rasterises the large ones that have been listed. If blades hide others, in the early pass
    /// those quarters that frames have shown lately, while their surfaces are kept, if they take
    /// turns, those by shared::lateQuartersUnseen(), and in the late one what of all the rest the
    /// frame's pyramid does not hide. As above.
    void recordLarge(VkCommandBuffer commands, const Input& input, Phase phase) const;

    /// Those of a pyramid; all of them once a frame.
    enum class Levels { finest, all };

    /// Fills levels of the frame's pyramid with what has been drawn so far; what is listed from now
    /// on has its late pass. As above.
    void recordDepths(VkCommandBuffer commands, const Input& input, Levels levels) const;

    /// What all shaders are told that draw into the visibility or look at it; but for tiles.
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
    gpu::ComputePipeline cut_; ///< those that reach through the near plane
    gpu::ComputePipeline lateBlades_;
    gpu::ComputePipeline lateLarge_; ///< leaves out what is hidden
    gpu::ComputePipeline depths_;
    gpu::ComputePipeline allDepths_;
    std::optional<ShadingCachePass> shadingCache_; ///< of the large blades that work-groups draw

    VkExtent2D size_{};
    bool isEmpty_ = false; ///< nothing is in the visibility when a frame begins
    gpu::Buffer visibility_;
    LargeBladeList largeList_;
};

} // namespace sward::render
