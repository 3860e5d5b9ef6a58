#pragma once

#include "gpu/pipeline/shader_library.h"
#include "gpu/pipeline/sharing_context.h"
#include "gpu/recording/recording.h"
#include "render/cull/pyramid_pass.h"
#include "render/cull/update_cull_pass.h"
#include "render/cull/walk_pass.h"
#include "render/frame/frame_time.h"
#include "render/grass.h"
#include "render/host/host_shadow_maps.h"
#include "render/raster/host_raster.h"
#include "render/resident/host_streaming.h"
#include "render/resident/placed_field.h"

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

namespace sward::render {

/// Members of the grass of a world, and the frame that is recorded.
struct Grass::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const Settings& wanted);

    /// A removed instance that commands in flight may still use.
    struct Removed {
        std::unique_ptr<PlacedField> field;
        std::uint32_t lastFrame = 0;
    };

    /// How recordCull() lists blades that recordUpdate() has moved.
    static constexpr UpdateCullPass::Variant culling{0, false, UpdateCullPass::Role::cull};

    /// How the blades of an instance are moved: by recordUpdate() for all views, or by the
    /// recordCull() of the only view.
    UpdateCullPass::Variant movingOf(const PlacedField& field) const;

    gpu::SharingContext sharing; ///< prepare() makes pipelines on any thread
    const gpu::DeviceContext& context;
    Settings settings;
    gpu::ShaderLibrary shaders;
    WalkPass walk;
    UpdateCullPass update;
    HostShadowMaps shadowMaps;
    HostRaster raster;
    HostStreaming streaming;
    std::shared_ptr<const void> owner = std::make_shared<char>(); ///< see ResidentField::Parts
    std::map<std::uint64_t, std::unique_ptr<PlacedField>> placed;
    std::vector<Removed> removed;
    std::uint64_t lastId = 0;

    // The frame being recorded.
    std::vector<std::uint32_t> frameOfSlot; ///< number of the frame last begun per slot
    std::uint32_t frame = 0;                ///< its number, starting at 1
    std::uint32_t slot = 0;
    std::uint32_t viewCount = 0;
    bool hasBegun = false;
    bool isUpdated = false;         ///< recordUpdate() has been called
    bool movesWithCull = false;     ///< of one view: recordCull() moves the blades, too
    UpdateCullPass::Variant moving; ///< of any instance: movingOf() adds what depends on it
    double time = 0.0;
    std::vector<const PlacedField*> instances; ///< with blades; null: removed since begin()

    /// How a view is drawn.
    struct ViewDrawing {
        const char* obstacle = nullptr;      ///< why it is not rasterised; null: none
        const char* storeObstacle = nullptr; ///< why it is not stored; null: none
        std::uint32_t samples = 1;
        bool hasReversedZ = true;
        bool hasTwoPasses = false; ///< see HostRaster::hasTwoPasses()
        bool isCulled = false;     ///< recordCull() has been called
        bool isRastered = false;   ///< in this frame, and stored if there is no obstacle
    };
    std::vector<ViewDrawing> drawings;

    /// Depth pyramid of a view in a slot.
    struct ViewDepth {
        DepthCells cells;
        const PyramidPass* pyramid = nullptr; ///< of the host's depth; null: none
        bool isOwn = false; ///< the rasteriser fills it from the visibility, not the pass
    };
    std::vector<ViewDepth> depths;                                          ///< [slot][view]
    std::map<std::tuple<std::uint32_t, bool, float>, PyramidPass> pyramids; ///< by their settings

    void requireRecording(VkCommandBuffer commands) const;
    const ViewDrawing& drawing(std::uint32_t view) const;
    void requireTarget(std::uint32_t view, const BladeTarget& target) const;
    PlacedField& instance(InstanceId id) const;

    std::uint32_t settledAt() const { return settledTick(time); } ///< in the wind of the frame

    ViewDepth& depthOf(std::uint32_t view) { return depths[slot * settings.maxViews + view]; }
    ViewPyramids lookAtDepth(const HostView& view, const ViewDrawing& drawing,
                             const FrameSettings& settings, ViewDepth& depth);

    void requireDevice(const ResidentField::Parts& field) const;
    void take(const ResidentField::Parts& field) const;
    void recordEdits(const gpu::Recording& commands) const;

    /// Calls `use` for each instance that is in the frame.
    template <typename Use>
    void forEach(const Use& use) const
    {
        for (const auto& [id, field] : placed)
            if (field->isInFrame(frame))
                use(*field);
    }

    void walkAll(const gpu::Recording& commands, std::uint32_t firstView, std::uint32_t endView,
                 bool isUpdate) const;
};

} // namespace sward::render
