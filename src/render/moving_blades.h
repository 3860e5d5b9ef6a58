#pragma once

#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "gpu/timestamps.h"
#include "render/field_buffers.h"
#include "render/frame_place.h"
#include "render/update_cull_pass.h"
#include "render/walk_pass.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// The blades of a field, and the passes of a frame that find those which may be seen, move them,
/// cull them and list those that are to be drawn.
class MovingBlades {
public:
    /// `testsSmall` as FieldRendererSettings::testsSmallBlades.
    MovingBlades(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                 FieldBuffers buffers, bool testsSmall);

    const FieldBuffers& buffers() const { return buffers_; }
    bool hasMoved() const { return hasMoved_; } ///< whether a frame has begun

    /// Makes room for what collisions leave, unless there is some: before the first frame with
    /// colliders is described.
    void expectColliders();

    /// Makes ready for the wind and the colliders of a frame; before the frame's begin().
    void prepare(const gpu::ShaderLibrary& shaders, const shared::Frame& frame);

    /// Waits for the frame before, and empties lists and counts. In the first frame, which is at
    /// `time` [s], blades are as they would be after having stood in their wind for some time.
    void begin(VkCommandBuffer commands, double time);

    /// Empties lists and counts for another list in the same frame. Blades that have been moved
    /// stay where they are: no time passes.
    void beginAgain(VkCommandBuffer commands) const;

    /// Finds the visible patches; with the barrier to what uses them. `cullView` is the frame by
    /// whose camera nodes are cullView.
    void findVisiblePatches(VkCommandBuffer commands, VkDeviceAddress cullView,
                            gpu::Timestamps* timestamps) const;

    /// Moves, culls and lists the blades of one round of visible patches; those that have not
    /// been shown from behind.
    void moveAndList(VkCommandBuffer commands, const FramePlace& cullView, std::uint32_t round,
                     UpdateCullPass::Shown shown, gpu::Timestamps* timestamps) const;

    /// Moves all blades, and does nothing else.
    void moveAll(VkCommandBuffer commands, const FramePlace& frame) const;

private:
    const gpu::DeviceContext* context_;
    FieldBuffers buffers_;
    WalkPass walk_;
    UpdateCullPass update_;
    UpdateCullPass::Variant variant_; ///< for the frame that is being recorded
    bool testsSmall_;
    bool hasMoved_ = false;
    bool hasNewEtas_ = false; ///< which hold nothing yet
};

} // namespace sward::render
