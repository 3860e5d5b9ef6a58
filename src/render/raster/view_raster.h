#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/frame/frame_settings.h"
#include "render/grass_frame.h"
#include "render/host/host_view.h"
#include "render/raster/large_blade_list.h"
#include "render/raster/raster_pass.h"
#include "render/raster/view_drawing.h"
#include "render/raster/view_passes.h"
#include "render/resolve/shading_cache.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sward::render {

class HostShadowMaps;
class PlacedField;

/// Rasterises the blades of a frame's views by compute shaders: all instances of a view into one
/// visibility buffer, initialised from the host's depth or by an opaque layer. HostLighting stores
/// the result into the host's picture, or BladeTarget draws it; with a layer the layer does.
class ViewRaster {
public:
    using Instances = std::span<const PlacedField* const>;

    /// Constant over all frames; motion takes 4 bytes per sample.
    struct Settings {
        std::uint32_t slots = 1, maxViews = 1;
        bool keepsMotion = false;
        bool groupsDrawLarge = true; ///< see RasterPass::Variant
        bool limitsLists = false;    ///< a view's list may have less room than the field has blades
    };

    ViewRaster(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
               const Settings& settings);

    bool drawsLargeByGroups() const { return settings_.groupsDrawLarge; }
    /// Why a view of these instances is not rasterised; null if it is.
    const char* obstacle(const HostView& view, Instances instances) const;

    /// Why a view is not stored into its picture, but may be drawn; null if it is.
    const char* storeObstacle(const HostView& view, Instances instances,
                              const FrameSettings& settings) const;

    /// Whether the depth pyramid of a view that is rasterised comes from the visibility buffer,
    /// which holds the host's depth. Else PyramidPass fills it from that depth, if there is one.
    static bool hasOwnPyramid(const HostView& view, const FrameSettings& settings);

    /// Whether a host's view that is rasterised has an early and a late pass.
    bool hasTwoPasses(const HostView& view, Instances instances,
                      const FrameSettings& settings) const;

    /// Begins a frame of these views in a completed `slot`, after its HostShadowMaps.
    void begin(const gpu::ShaderLibrary& shaders, std::uint32_t slot,
               std::span<const HostView> views, std::span<const ViewDrawing> drawings,
               Instances instances, const FrameSettings& settings);

    /// Makes the pipelines that begin() needs for frames like this one. On any thread.
    void preparePipelines(const gpu::ShaderLibrary& shaders, const GrassFrame& frame,
                          const PreparedFields& fields) const;

    /// Fills the visibility with the host's depth, and clears lists: before the view is culled.
    /// `depth`: the host's, as PyramidPass reads it, or null; it fills the view's own pyramid, too.
    /// Needs a barrier to fills before; records one to dispatches after.
    void recordBegin(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                     const gpu::ImageSet* depth);

    /// The same for a view with an opaque layer, whose depths fill its pyramid if `fillsPyramid`.
    void recordLayer(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                     bool fillsPyramid, gpu::Timestamps* timestamps);

    /// Rounds of a view's lists, see RasterRounds.
    struct Rounds {
        std::uint32_t count = 1;
        std::function<void(std::uint32_t round)> list{}; ///< unset: the lists are full
        std::function<void(const shared::HostViewPush&)> beforeLight{}; ///< reads a host's ids
    };

    /// Rasterises the view's lists, and lights the blades unless a layer does. Needs a barrier from
    /// the cull before; records one after.
    void record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                Instances instances, const Rounds& rounds, gpu::Timestamps* timestamps);

    /// For the shaders that make a layer's picture, without tiles.
    const shared::RasterPush& pushOf(std::uint32_t slot, std::uint32_t view) const;
    /// Draws the result into the host's picture, tile by tile; `pipeline` is a BladeTarget's.
    void recordDraw(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                    const gpu::GraphicsPipeline& pipeline) const;

    VkDeviceSize bytes() const;

private:
    /// Kept until no slot uses them.
    struct Pictures {
        std::shared_ptr<gpu::Buffer> visibility, tiles, motions; ///< of shared::HostViewPush
        bool isEmpty = false; ///< a layer's picture leaves the visibility empty
    };

    /// A view of the frame last begun in a slot.
    struct View {
        bool isRastered = false;
        ViewDrawing drawing;
        Pictures pictures;
        std::shared_ptr<LargeBladeList> large;
        ViewPasses::Pipelines pipelines;
        HostLighting::View lighting;
        shared::HostViewPush push = {};
        std::vector<RasterPass::Instance> instances;
    };

    struct Slot {
        gpu::Buffer table; ///< shared::HostInstance, [view][instance]
        std::vector<View> views;
    };

    void prepare(const HostView& view, const ViewDrawing& drawing, std::uint32_t index, View& out);
    void prepareShading(const gpu::ShaderLibrary& shaders, std::uint32_t slot, std::uint32_t index,
                        const HostView& view, const ViewDrawing& drawing, Instances instances,
                        const FrameSettings& settings);
    void writeTable(Slot& slot, std::uint32_t slotIndex, std::span<const HostView> views,
                    Instances instances) const;
    static RasterPass::View viewOf(const View& view);

    const gpu::DeviceContext* context_;
    const HostShadowMaps* shadowMaps_;
    Settings settings_;
    ViewPasses passes_;
    std::optional<ShadingCache> shadingCache_;  ///< made on first use; shared by all views
    std::shared_ptr<LargeBladeList> largeList_; ///< shared by all views in sequence …
    std::optional<std::uint32_t> clearedFor_;   ///< … and cleared for this view, if unused since
    std::vector<Pictures> pictures_;            ///< the newest per view
    std::vector<Slot> slots_;
};

} // namespace sward::render
