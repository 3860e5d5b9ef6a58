#pragma once

#include "gpu/memory/buffer.h"
#include "gpu/pipeline/uniform_sets.h"
#include "gpu/recording/recording.h"
#include "render/field/blade_states.h"
#include "render/field/outgrown.h"
#include "render/field/visibility_history.h"
#include "render/field/visible_blades.h"
#include "render/frame/frame_place.h"
#include "render/frame/frame_settings.h"
#include "render/frame/frame_stats.h"
#include "render/grass.h"
#include "render/resident/resident_parts.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// What hides blades in a view.
struct ViewPyramids {
    shared::DepthPyramid culling = {}; ///< for the cull; without depths it hides nothing
    shared::DepthPyramid raster = {};  ///< for the late pass
};

/// One instance: a field's blades with their own state, and the constants of its frames.
class PlacedField {
public:
    PlacedField(const gpu::DeviceContext& context, const FieldInstance& instance,
                const Grass::Settings& settings);

    void place(const Placement& placement) { instance_.placement = placement; }

    /// Writes frame `number` for the shaders, and allocates lists for its views if needed.
    void write(std::uint32_t slot, const GrassFrame& frame, std::uint32_t number,
               std::span<const ViewPyramids> pyramids);

    /// Makes the visibility history of a view, unless there is one.
    void expectHistory(std::uint32_t view);
    VisibilityHistory& history(std::uint32_t view) { return histories_[view]; }
    const VisibilityHistory& history(std::uint32_t view) const { return histories_[view]; }

    bool isInFrame(std::uint32_t number) const { return written_ == number; }
    bool isUploaded() const { return instance_.field->isUploaded(); }

    const BakedBlades& blades() const { return Access::of(*instance_.field).blades; }
    const BladeStates& states() const { return states_; }
    const VisibleBlades& list(std::uint32_t view) const { return lists_[view]; }
    const ResidentField& field() const { return *instance_.field; }

    /// Whether a view's list has room for every blade.
    bool listsHoldAll() const { return settings_.maxListed >= blades().placeCount(); }
    const gpu::Buffer& moved() const { return moved_; } ///< shared::DrawArguments of the update

    /// Frames of one view: for moving its blades, for culling, and for drawing with either
    /// back-end. The update frames of all views are contiguous.
    FramePlace updateFrame(std::uint32_t slot, std::uint32_t view) const;
    FramePlace cullView(std::uint32_t slot, std::uint32_t view) const;
    FramePlace drawnFrame(std::uint32_t slot, std::uint32_t view) const;
    FramePlace rasterFrame(std::uint32_t slot, std::uint32_t view) const; ///< always reversed Z

    /// shared::Motion of one view.
    VkDeviceAddress motion(std::uint32_t slot, std::uint32_t view) const;

    /// Wind and colliders of the frame written last.
    const shared::Environment& environment() const { return environment_; }

    /// Culling eyepoints of the views of the frame written last.
    std::span<const shared::Eyepoint> seen() const { return seen_; }

    /// Raises the lodThreshold of that frame, which the device has not read yet: one per view.
    void thin(std::uint32_t slot, std::span<const shared::Eyepoint> raised) const;

    /// The streaming of its field; null if all blades are resident.
    Streaming* streaming() const { return Access::of(*instance_.field).streaming.get(); }

    /// The edits of its field; null if it is not editable.
    ResidentEdits* edits() const { return Access::of(*instance_.field).edits.get(); }

    /// Copies the states to larger buffers, if edits have replaced these. The former commands of
    /// `slot` must have completed.
    void recordReplaced(const gpu::Recording& commands, std::uint32_t slot);

    /// Before the blades move to `time` [s]: settles them in its wind in the first frame, and where
    /// they do not move on, see render::movesOn().
    void recordStart(const gpu::Recording& commands, double time);

    /// Copies counts to the memory that counts() reads, after a barrier to transfers.
    void recordMoved(const gpu::Recording& commands, std::uint32_t slot) const;
    void recordCounts(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view) const;
    void addCounts(std::uint32_t slot, std::uint32_t view, FrameStats& sum) const;

    VkDeviceSize bytes() const;

private:
    struct Slot {
        gpu::Buffer constants;    ///< tables; of each view: four frames, shared::Motion, HostLight
        gpu::UniformSets frames;  ///< of those frames
        gpu::Buffer counts;       ///< shared::DrawArguments of the update, then of each view
        std::uint64_t blades = 0; ///< of the field in that frame
    };

    void followEdits();

    VkDeviceSize motionOffset(std::uint32_t view) const;
    VkDeviceSize lightOffset(std::uint32_t view) const;
    shared::Motion motionOf(const GrassFrame& frame, const HostView& view) const;
    std::uint32_t frameIndex(std::uint32_t kind, std::uint32_t view) const;
    VkDeviceSize frameOffset(std::uint32_t kind, std::uint32_t view) const;
    FramePlace framePlace(std::uint32_t slot, std::uint32_t kind, std::uint32_t view) const;
    void put(std::uint32_t slot, std::uint32_t kind, std::uint32_t view,
             const shared::Frame& frame) const;

    const gpu::DeviceContext* context_;
    FieldInstance instance_;
    Grass::Settings settings_;
    BladeStates states_;
    gpu::Buffer moved_;
    std::vector<VisibleBlades> lists_;
    std::vector<VisibilityHistory> histories_; ///< by view; empty ones unless there are two passes
    bool hasNewEtas_ = false;                  ///< the collision state is uninitialised
    ReplacedBuffers replaced_;
    std::vector<Slot> slots_;
    std::vector<shared::Eyepoint> seen_;
    shared::Environment environment_ = {};
    Placement placementBefore_; ///< of the frame written before
    double timeBefore_ = 0.0;
    double movedTo_ = 0.0;      ///< [s] time of the last motion
    std::uint32_t written_ = 0; ///< number of the frame written last
    bool hasMoved_ = false;
};

} // namespace sward::render
