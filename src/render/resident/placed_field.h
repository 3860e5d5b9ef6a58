#pragma once

#include "gpu/memory/buffer.h"
#include "gpu/recording/recording.h"
#include "render/field/blade_states.h"
#include "render/field/outgrown.h"
#include "render/field/visibility_history.h"
#include "render/field/visible_blades.h"
#include "render/frame/frame_stats.h"
#include "render/resident/device_field.h"
#include "render/resident/instance_constants.h"
#include "render/resident/instance_frame.h"
#include "render/resident/resident_field.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sward::render {

/// One instance: a field's blades with their own state, and the constants of its frames.
class PlacedField {
public:
    /// Constant over all frames.
    struct Settings {
        std::uint32_t framesInFlight = 1;
        std::uint32_t maxViews = 1;
        bool keepsMotion = false;                 ///< the states before the last motion
        bool keepsCullResults = false;            ///< of each blade
        std::uint32_t maxListed = 0xffffffffu;    ///< blades of a view's list
        std::uint32_t roundPatches = 0xffffffffu; ///< visible patches of a view's list
    };

    /// The field must outlive it; `resident` keeps it, and says when it is uploaded. Null: it is.
    PlacedField(const gpu::DeviceContext& context, const DeviceField& field,
                const Settings& settings, std::shared_ptr<const ResidentField> resident = nullptr);

    /// Makes the lists of so many views; write() does so for those of its frame.
    void expectViews(std::uint32_t views);

    /// Writes frame `number` of the grass for the shaders, and allocates lists for its views if
    /// needed.
    void write(std::uint32_t slot, const InstanceFrame& frame, std::uint32_t number);

    /// Makes the visibility history of a view, unless there is one.
    void expectHistory(std::uint32_t view);
    VisibilityHistory& history(std::uint32_t view) { return histories_[view]; }
    const VisibilityHistory& history(std::uint32_t view) const { return histories_[view]; }
    void expectShadow(std::uint32_t view); ///< likewise the list of patches of its shadow box
    const VisibleBlades& shadowList(std::uint32_t view) const { return *shadows_[view]; }
    bool isInFrame(std::uint32_t number) const { return written_ == number; }
    bool isUploaded() const { return !resident_ || resident_->isUploaded(); }
    bool hasMoved() const { return hasMoved_; } ///< a frame has been recorded

    const DeviceField& field() const { return *field_; }
    const BakedBlades& blades() const { return field_->blades; }
    const BladeStates& states() const { return states_; }
    void forgetMotion() { hasMoved_ = false; } ///< the next frame is as the first one
    const VisibleBlades& list(std::uint32_t view) const { return lists_[view]; }
    /// Whether a view's list has room for every blade.
    bool listsHoldAll() const { return settings_.maxListed >= blades().placeCount(); }
    const gpu::Buffer& moved() const { return moved_; } ///< shared::DrawArguments of the update

    /// Cull results of the blades in memory; empty unless they are kept.
    const gpu::Buffer& cullResults() const { return cullResults_; }

    /// Before a frame culls: every blade counts as culled with its patch.
    void clearCullResults(const gpu::Recording& commands) const;

    /// Upper bound of the rounds in which a view of the frame written last lists its blades.
    std::uint32_t roundCount(std::uint32_t view) const;

    /// A frame of one view.
    FramePlace place(std::uint32_t slot, InstanceConstants::Kind kind, std::uint32_t view) const
    {
        return constants_.place(slot, kind, view);
    }

    /// shared::Motion of one view.
    VkDeviceAddress motion(std::uint32_t slot, std::uint32_t view) const
    {
        return constants_.motion(slot, view);
    }
    /// Wind and colliders of the frame written last.
    const shared::Environment& environment() const { return environment_; }

    /// Culling eyepoints of the views of the frame written last.
    std::span<const shared::Eyepoint> seen() const { return seen_; }

    /// Raises the lodThreshold of that frame, which the device has not read yet: one per view.
    void thin(std::uint32_t slot, std::span<const shared::Eyepoint> raised);

    // Streaming, sowing and edits of its field; null where there are none.
    Streaming* streaming() const { return field_->streaming.get(); }
    Sowing* sowing() const { return field_->sowing.get(); }
    ResidentEdits* edits() const { return field_->edits.get(); }

    /// Makes room for what edits have added to its field.
    void followEdits();

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

    /// What bytes() counts besides states, lists, cull results and histories.
    static VkDeviceSize constantBytes(const Settings& settings);

private:
    shared::Motion motionOf(const InstanceFrame& frame, const InstanceView& view) const;

    const gpu::DeviceContext* context_;
    const DeviceField* field_;
    Settings settings_;
    std::shared_ptr<const ResidentField> resident_;
    BladeStates states_;
    gpu::Buffer moved_;
    std::vector<VisibleBlades> lists_;
    gpu::Buffer cullResults_;
    std::vector<VisibilityHistory> histories_; ///< by view; empty ones unless there are two passes
    std::vector<std::optional<VisibleBlades>> shadows_; ///< by view; they list patches alone
    bool hasNewEtas_ = false;                           ///< the collision state is uninitialised
    ReplacedBuffers replaced_;
    InstanceConstants constants_;
    std::vector<std::uint64_t> bladesOfSlot_;   ///< blades of the field in each slot's frame
    std::vector<std::uint64_t> residentOfSlot_; ///< of these, in memory; of a sown field
    std::vector<shared::Eyepoint> seen_;
    shared::Environment environment_ = {};
    double timeBefore_ = 0.0;
    double movedTo_ = 0.0;      ///< [s] time of the last motion
    std::uint32_t written_ = 0; ///< number of the frame written last
    bool hasMoved_ = false;
};

} // namespace sward::render
