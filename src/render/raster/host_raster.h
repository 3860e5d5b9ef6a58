#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/frame_settings.h"
#include "render/host_view.h"
#include "render/raster/large_blade_list.h"
#include "render/resolve/host_lighting.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sward::render {

class HostShadowMaps;
class PlacedField;

/// Rasterises the blades of a host's views by compute shaders: all instances of a view into one
/// visibility buffer, initialised from the host's depth. HostLighting stores the result into the
/// host's picture, or BladeTarget draws it.
class HostRaster {
public:
    using Instances = std::span<const PlacedField* const>;
    /// Constant over all frames; motion takes 4 bytes per sample.
    struct Settings {
        std::uint32_t slots = 1, maxViews = 1;
        bool keepsMotion = false;
    };

    HostRaster(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
               const Settings& settings);

    /// Why a view of these instances is not rasterised; null if it is.
    const char* obstacle(const HostView& view, Instances instances) const;

    /// Why a view is not stored into its picture, but may be drawn; null if it is.
    const char* storeObstacle(const HostView& view, Instances instances,
                              const FrameSettings& settings) const;

    /// Begins a frame in a completed `slot`, after its HostShadowMaps; makes objects on first use.
    void begin(const gpu::ShaderLibrary& shaders, std::uint32_t slot,
               std::span<const HostView> views, Instances instances, const FrameSettings& settings);

    /// Rasterises and lights the view's lists. `depth`: the host's, as PyramidPass reads it, or
    /// null. Records a barrier before and after.
    void record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                Instances instances, const gpu::ImageSet* depth) const;

    /// Draws the result into the host's picture, tile by tile; `pipeline` is a BladeTarget's.
    void recordDraw(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                    const gpu::GraphicsPipeline& pipeline) const;

    VkDeviceSize bytes() const;

private:
    struct Pipelines {
        gpu::ComputePipeline blades, cut, pagedBlades; ///< the latter of streamed fields, if any
        gpu::ComputePipeline large;                    ///< unused on a CPU device
    };

    /// Kept until no slot uses them.
    struct Pictures {
        std::shared_ptr<gpu::Buffer> visibility, tiles, motions; ///< of shared::HostViewPush
    };

    /// A view of the frame last begun in a slot.
    struct View {
        Pictures pictures;
        std::shared_ptr<LargeBladeList> large;
        const Pipelines* pipelines = nullptr; ///< null: the view is not rasterised
        HostLighting::View lighting;
        const gpu::ComputePipeline* seed = nullptr; ///< null: the visibility starts cleared
        shared::HostViewPush push = {};
        std::vector<shared::RasterPush> pushes; ///< one per instance
    };

    struct Slot {
        gpu::Buffer table; ///< shared::HostInstance, [view][instance]
        std::vector<View> views;
    };

    Pipelines pipelinesFor(const gpu::ShaderLibrary& shaders, std::uint32_t samples) const;
    gpu::ComputePipeline seedFor(const gpu::ShaderLibrary& shaders, std::uint32_t samples,
                                 bool hasReversedZ) const;
    void prepare(const gpu::ShaderLibrary& shaders, const HostView& view, std::uint32_t index,
                 bool hasPaged, View& out);
    void writeTable(Slot& slot, std::uint32_t slotIndex, std::span<const HostView> views,
                    Instances instances) const;

    const gpu::DeviceContext* context_;
    Settings settings_;
    HostLighting lighting_;
    gpu::UniformSetLayout frameLayout_;
    gpu::ImageSetLayout imageLayout_;              ///< compatible with PyramidPass
    std::map<std::uint32_t, Pipelines> pipelines_; ///< by samples
    std::map<std::pair<std::uint32_t, bool>, gpu::ComputePipeline> seeds_; ///< reversed: true
    std::shared_ptr<LargeBladeList> largeList_; ///< shared by all views in sequence
    std::vector<Pictures> pictures_;            ///< the newest per view
    std::vector<Slot> slots_;
};

} // namespace sward::render
