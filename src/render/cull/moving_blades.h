#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "gpu/recording/timestamps.h"
#include "render/cull/field_buffers.h"
#include "render/cull/update_cull_pass.h"
#include "render/cull/walk_pass.h"
#include "render/edits/field_edits.h"
#include "render/field/outgrown.h"
#include "render/frame/frame_place.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace sward::render {

/// The blades of a field, and the passes of a frame that find visible patches, then move, cull and
/// list their blades.
class MovingBlades {
public:
    /// `testsSmall`: see FieldRendererSettings::testsSmallBlades.
    MovingBlades(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                 FieldBuffers buffers, bool testsSmall);

    /// Lets blades be edited that have been uploaded with the places of `edited`. The cover
    /// must outlive this.
    void expectEdits(const gpu::ShaderLibrary& shaders, std::unique_ptr<EditedField> edited,
                     GrassCover& cover, std::uint32_t framesInFlight);

    /// The edited field; null unless edits are expected.
    const EditedField* edited() const { return edits_ ? &edits_->field() : nullptr; }

    /// Replaces cells, with the next begin(). Edits must be expected. See FieldEdits.
    void apply(const field::Delta& delta);

    /// Buffers that an edit has replaced until the next begin(). Edits must be expected.
    OutgrownBuffers& replaced() { return replaced_->waiting(); }

    const FieldBuffers& buffers() const { return buffers_; }
    bool hasMoved() const { return hasMoved_; } ///< whether a frame has begun

    /// Allocates collision state unless present. Call before describing the first frame with
    /// colliders.
    void expectColliders();

    /// Prepares pipelines for the wind and colliders of a frame; before the frame's begin().
    void prepare(const gpu::ShaderLibrary& shaders, const shared::Frame& frame);

    /// Waits for the frame before, clears lists and counts, and carries out edits. In the first
    /// frame, at `time` [s], blades start settled in their wind; and where they do not move on, see
    /// movesOn(). The former commands of `slot` must
    /// have completed.
    void begin(const gpu::Recording& commands, double time, std::uint32_t slot);

    /// Clears lists and counts for another list in the same frame. Blades are not moved again,
    /// since no time passes.
    void beginAgain(const gpu::Recording& commands) const;

    /// Finds the visible patches and records the barrier to their readers. `cullView` is the frame
    /// whose camera tests the nodes.
    void findVisiblePatches(const gpu::Recording& commands, VkDeviceAddress cullView,
                            gpu::Timestamps* timestamps) const;

    /// Moves, culls and lists the blades of one round of visible patches. Blades that the
    /// visibility history does not contain are listed from the back.
    void moveAndList(const gpu::Recording& commands, const FramePlace& cullView,
                     std::uint32_t round, UpdateCullPass::History history,
                     gpu::Timestamps* timestamps) const;

    /// Only moves all blades.
    void moveAll(const gpu::Recording& commands, const FramePlace& frame) const;

private:
    const gpu::DeviceContext* context_;
    FieldBuffers buffers_;
    WalkPass walk_;
    UpdateCullPass update_;
    UpdateCullPass::Variant variant_; ///< for the frame being recorded
    std::optional<FieldEdits> edits_;
    std::optional<ReplacedBuffers> replaced_; ///< if there are edits
    bool testsSmall_;
    bool hasMoved_ = false;
    double movedTo_ = 0.0;    ///< [s] time of the last motion
    bool hasNewEtas_ = false; ///< collision state is uninitialised
};

} // namespace sward::render
