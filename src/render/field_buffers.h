#pragma once

#include "field/distributions.h"
#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/buffer_upload.h"
#include "gpu/context.h"
#include "render/baked_blades.h"
#include "render/blade_states.h"
#include "render/visible_blades.h"
#include "render/visible_patch_bound.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The blades of a field that is drawn in one place and one view: in device memory, with what moves
/// between its frames.
class FieldBuffers {
public:
    /// What is kept for each blade besides itself and its state, and how patches are gone through.
    struct Records {
        bool list = false; ///< a place in the list of visible blades; else there may be rounds
        bool cullResults = false;       ///< its cull result
        bool etas = false;              ///< what collisions leave; else from the first collider on
        std::uint32_t roundPatches = 0; ///< visible patches of a round; 0: roundPatchesOf() says it
        std::uint32_t walkStart = shared::walkStart; ///< nodes that a walk begins with, or less
        std::uint32_t pages = 0; ///< of blades that there is room for; 0: all blades are there

        /// Of each blade there is room for; `withEtas`: as from the first collider on.
        VkDeviceSize bytesPerBlade(bool withEtas) const;
    };

    /// Live patches of a round of a field with so many places for blades, unless the list has room
    /// for all: those asked for, or as many as 2 bytes for each place hold, or 268 MB where
    /// everything is in memory.
    static std::uint32_t roundPatchesOf(const PatchSizes& sizes, const Records& records,
                                        std::uint64_t places, bool isPaged);

    /// Begins the upload; it is complete when `upload` is. Throws Error{runtime} if the device's
    /// memory is too small, naming both sizes.
    FieldBuffers(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                 const field::FieldView& field, Records records);

    /// Writes addresses and counts into a frame.
    void describe(shared::Frame& frame) const;

    /// Puts every blade at rest, last moved at `time` [s].
    void rest(VkCommandBuffer commands, float time) const { states_.rest(commands, time); }

    /// See BladeStates.
    void keepEtas(const gpu::DeviceContext& context) { states_.keepEtas(context); }
    bool hasEtas() const { return states_.hasEtas(); }
    void clearEtas(VkCommandBuffer commands) const { states_.clearEtas(commands); }

    /// Empties the list of visible blades, the walk's lists, and the counts.
    void clearCounts(VkCommandBuffer commands) const { list_.clear(commands); }

    /// Forgets the recorded cull results of the frame before.
    void clearCullResults(VkCommandBuffer commands) const;

    const BakedBlades& baked() const { return baked_; }
    const VisibleBlades& list() const { return list_; }
    std::uint32_t bladeCount() const { return baked_.bladeCount(); }
    field::BladeSize bladeSize() const { return baked_.bladeSize(); } ///< mean over all blades

    /// How often the visible patches of a view, of which so many may be in memory, fill the list of
    /// visible blades at most.
    std::uint32_t roundCount(const shared::Frame& cullView, std::uint64_t resident) const;
    VkDeviceSize bytes() const;

    const gpu::Buffer& draw() const { return list_.draw(); } ///< shared::DrawArguments
    const BladeStates& ownStates() const { return states_; }
    const gpu::Buffer& states() const { return states_.states(); }
    const gpu::Buffer& etas() const { return states_.etas(); }
    const gpu::Buffer& visible() const { return list_.visible(); }
    const gpu::Buffer& cullResults() const
    {
        return cullResults_;
    } ///< nothing unless they are recorded

private:
    BakedBlades baked_;
    BladeStates states_;
    VisibleBlades list_;
    VisiblePatchBound visiblePatchBound_;
    gpu::Buffer cullResults_;
};

} // namespace sward::render
