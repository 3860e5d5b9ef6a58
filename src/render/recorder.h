#pragma once

#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/sharing_context.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/cull/pyramid_pass.h"
#include "render/cull/update_cull_pass.h"
#include "render/cull/walk_pass.h"
#include "render/frame/frame_time.h"
#include "render/grass.h"
#include "render/host/host_shadow_maps.h"
#include "render/layers/host_layers_pass.h"
#include "render/raster/blade_shadow_pass.h"
#include "render/raster/view_raster.h"
#include "render/recorder_extras.h"
#include "render/resident/host_frame.h"
#include "render/resident/instance_streaming.h"
#include "render/resident/placed_field.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace sward::render {

/// The recorder of frames: instances of fields, and views of them all. Grass hands it the frames of
/// hosts; FieldRenderer those of a single field on its own ground.
struct Recorder {
    Recorder(const gpu::DeviceContext& deviceContext, const Grass::Settings& wanted,
             const RecorderExtras& extras = {});

    /// How recordCull() lists blades that recordUpdate() has moved.
    static constexpr UpdateCullPass::Variant culling{0, false, UpdateCullPass::Role::cull};

    /// An instance in the host's world.
    struct Placed {
        std::unique_ptr<PlacedField> field;
        PlacementOverTime placement{};
        bool isWritten = false; ///< a frame of it
    };

    /// A removed instance that commands in flight may still use.
    struct Removed {
        std::unique_ptr<PlacedField> field;
        std::uint32_t lastFrame = 0;
    };

    gpu::SharingContext sharing; ///< Grass::prepare() makes pipelines on any thread
    const gpu::DeviceContext& context;
    Grass::Settings settings;
    gpu::ShaderLibrary shaders;
    WalkPass walk;
    UpdateCullPass update;
    HostShadowMaps shadowMaps;
    ViewRaster raster;
    std::optional<HostLayersPass> hostLayers; ///< made when a view wants some
    BladeShadowPass bladeShadows;
    bool testsSmall; ///< see UpdateCullPass::Variant
    InstanceStreaming streaming;
    std::map<std::uint64_t, Placed> placed;
    std::vector<Removed> removed;
    std::uint64_t lastId = 0;

    // The frame being recorded.
    std::vector<std::uint32_t> frameOfSlot;           ///< number of the frame last begun per slot
    std::uint32_t frame = 0, slot = 0, viewCount = 0; ///< frames are numbered from 1 on
    bool hasBegun = false, isUpdated = false;         ///< the latter: recordUpdate() was called
    bool movesWithCull = false;     ///< of one view: recordCull() moves the blades, too
    UpdateCullPass::Variant moving; ///< of any instance: movingOf() adds what depends on it
    double time = 0.0;
    std::vector<PlacedField*> instances;    ///< with blades; null: removed since begin()
    std::vector<std::uint64_t> instanceIds; ///< of these, keys of `placed`
    std::vector<ViewDrawing> drawings;
    ViewExtras extras; ///< of the first view

    /// Depth pyramid of a view in a slot.
    struct ViewDepth {
        DepthCells cells;
        const PyramidPass* pyramid = nullptr; ///< of the host's depth; null: none
        bool isOwn = false; ///< the rasteriser fills it from the visibility, not the pass
        bool hides = false; ///< blades from the cull
    };
    std::vector<ViewDepth> depths;                                          ///< [slot][view]
    std::map<std::tuple<std::uint32_t, bool, float>, PyramidPass> pyramids; ///< by their settings
    /// An instance in the space of its field, without pyramids.
    using ToInstance = std::function<InstanceFrame(const Placed&)>;

    /// Writes a frame; creates objects on first use. Records nothing. See Grass::begin().
    void begin(std::uint32_t slot, const GrassFrame& frame, const ViewExtras& viewExtras,
               const ToInstance& toInstance);

    // The passes of a frame, in order; see Grass. Times may be null.
    void recordUpdate(const gpu::Recording& commands);
    void recordCull(const gpu::Recording& commands, std::uint32_t view, gpu::Timestamps* times);
    void recordRaster(const gpu::Recording& commands, std::uint32_t view, gpu::Timestamps* times);
    /// Instead of these: moves all blades, and lists none.
    void recordMoveAll(const gpu::Recording& commands);

    ViewDepth& depthOf(std::uint32_t view) { return depths[slot * settings.maxViews + view]; }
    std::uint32_t settledAt() const { return settledTick(time); } ///< in the wind of the frame

    /// Calls `use` for each instance that is in the frame.
    template <typename Use>
    void forEach(const Use& use) const
    {
        for (const auto& [id, instance] : placed)
            if (instance.field->isInFrame(frame))
                use(*instance.field);
    }
    VkDeviceSize deviceBytes() const; ///< of instances, lists and pictures

    /// How blades are moved in frames like this one, of any field and without wind.
    UpdateCullPass::Variant movingLike(const GrassFrame& frame) const;

    /// What makes a view's depth pyramid; unset: it has none. `isOwn`: see ViewDepth.
    static std::optional<PyramidPass::Settings>
    pyramidOf(const HostView& view, const FrameSettings& frameSettings, bool isOwn);

private:
    UpdateCullPass::Variant movingOf(const PlacedField& field) const;
    void beginInstances();
    void beginViews(const GrassFrame& frame);
    void beginLayers(const GrassFrame& frame);
    ViewDrawing drawingOf(const HostView& view, const FrameSettings& frameSettings) const;
    void lookAtDepth(const HostView& view, const ViewDrawing& drawing,
                     const FrameSettings& frameSettings, ViewDepth& depth);
    void addPyramids(InstanceFrame& instance, const GrassFrame& frame);
    void addShadows(InstanceFrame& instance, PlacedField& field);
    void recordBegin(const gpu::Recording& commands);
    void recordEdits(const gpu::Recording& commands) const;
    void walkAll(const gpu::Recording& commands, std::uint32_t firstView, std::uint32_t endView,
                 bool isUpdate) const;
    void walkAgain(const gpu::Recording& commands, std::uint32_t view) const;
    void recordDepth(const gpu::Recording& commands, std::uint32_t view, gpu::Timestamps* times);
    void recordLists(const gpu::Recording& commands, std::uint32_t view, std::uint32_t round,
                     bool listsAll, gpu::Timestamps* times) const;
    void recordShadow(const gpu::Recording& commands, std::uint32_t view,
                      gpu::Timestamps* times) const;
    void recordCounts(const gpu::Recording& commands, std::uint32_t view) const;
};

/// How blades of a field are moved; `moving`: of any field.
UpdateCullPass::Variant movingIn(UpdateCullPass::Variant moving, const BakedBlades& blades);

} // namespace sward::render
