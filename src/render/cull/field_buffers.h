#pragma once

#include "field/delta.h"
#include "field/field.h"
#include "field/measure/distributions.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/buffer_upload.h"
#include "gpu/recording/recording.h"
#include "render/cull/visible_patch_bound.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/field/visible_blades.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The blades of a field with one placement and one view, in device memory, and the state that
/// persists between frames.
class FieldBuffers {
public:
    /// Optional storage per blade besides blade and state, and how the walk visits patches.
    struct Records {
        bool list = false;        ///< list of visible blades for all; else rounds are possible
        bool cullResults = false; ///< cull results
        bool etas = false;        ///< collision state; else from the first collider on
        std::uint32_t roundPatches = 0; ///< visible patches per round; 0: by roundPatchesOf()
        std::uint32_t walkStart = shared::walkStart; ///< nodes that a walk begins with, at most
        std::uint32_t pages = 0; ///< pages of blades in memory; 0: all blades are resident

        /// Bytes per resident blade. `withEtas`: including collision state.
        VkDeviceSize bytesPerBlade(bool withEtas) const;
    };

    /// Visible patches of a round for a field with `places` resident blades, unless the list holds
    /// all. `records.roundPatches` if set; else what fits in a list of 2 bytes per place, or, if
    /// all blades are resident, of at least 268 MB (or all).
    static std::uint32_t roundPatchesOf(const PatchSizes& sizes, const Records& records,
                                        std::uint64_t places, bool isPaged);

    /// Begins the upload; it is complete when `upload` is. `edited`: null if the field is never
    /// edited. Throws Error{runtime} if the device's memory is too small, naming both sizes.
    FieldBuffers(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                 const field::FieldView& field, Records records,
                 const EditedField* edited = nullptr);

    /// Follows an edit, whose bytes the caller uploads: counts, and room for more. `outgrown` gets
    /// what is replaced.
    void update(const gpu::DeviceContext& context, const EditedField& edited,
                const field::Delta& delta, OutgrownBuffers& outgrown);

    /// Writes addresses and counts into a frame.
    void describe(shared::Frame& frame) const;

    /// Puts every blade at rest, with `time` [s] as the time of its last update.
    void rest(const gpu::Recording& commands, std::uint32_t tick) const
    {
        states_.rest(commands, tick);
    }
    void settle(const gpu::Recording& commands, std::uint32_t tick) const
    {
        states_.settle(commands, tick);
    }

    /// See BladeStates.
    void keepEtas(const gpu::DeviceContext& context) { states_.keepEtas(context); }
    bool hasEtas() const { return states_.hasEtas(); }
    void clearEtas(const gpu::Recording& commands) const { states_.clearEtas(commands); }

    /// Clears the list of visible blades, the walk's lists, and the counts.
    void clearCounts(const gpu::Recording& commands) const { list_.clear(commands); }

    /// Resets the cull results of the frame before.
    void clearCullResults(const gpu::Recording& commands) const;

    const BakedBlades& baked() const { return baked_; }
    const VisibleBlades& list() const { return list_; }
    std::uint32_t bladeCount() const { return baked_.bladeCount(); }
    field::BladeSize bladeSize() const { return baked_.bladeSize(); } ///< mean over all blades

    /// Upper bound of the rounds that a view needs for its visible patches. `resident`: upper bound
    /// of those in memory.
    std::uint32_t roundCount(const shared::Frame& cullView, std::uint64_t resident) const;
    VkDeviceSize bytes() const;

    const gpu::Buffer& draw() const { return list_.draw(); } ///< shared::DrawArguments
    const BladeStates& ownStates() const { return states_; }
    const gpu::Buffer& states() const { return states_.states(); }
    const gpu::Buffer& etas() const { return states_.etas(); }
    const gpu::Buffer& visible() const { return list_.visible(); }
    const gpu::Buffer& cullResults() const { return cullResults_; } ///< empty unless recorded

private:
    BakedBlades baked_;
    BladeStates states_;
    VisibleBlades list_;
    VisiblePatchBound visiblePatchBound_;
    gpu::Buffer cullResults_;
};

} // namespace sward::render
