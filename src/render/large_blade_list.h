#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/recording.h"
#include "render/update_cull_pass.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The blades that cover many pixels, as the rasteriser lists them: shared::LargePart, how many
/// have been asked for, and what dispatches those that are listed.
class LargeBladeList {
public:
    LargeBladeList() = default;

    /// For what there is room beside shared::maxCutBlades.
    struct Room {
        bool large = false; ///< shared::maxLargeParts
        std::uint32_t shownBlades =
            0; ///< a bit for each quarter, if some are to be left out as hidden
    };

    LargeBladeList(const gpu::DeviceContext& context, Room room);

    void describe(shared::RasterPush& push) const; ///< where shaders find all but those bits

    /// A bit for each quarter of each blade: see shared::RasterPush::seen.
    UpdateCullPass::Shown shown() const { return {shown_.address(), frame_}; }

    /// Empties it; a transfer.
    void clear(const gpu::Recording& commands) const;

    /// Begins a frame. Before the first one no blade has been shown; a transfer, once.
    void beginShown(const gpu::Recording& commands);

    // Work-groups for what is listed: large parts in the early pass, the same in the late pass, and
    // blades that the near plane cuts.
    void dispatch(const gpu::Recording& commands) const;
    void dispatchLate(const gpu::Recording& commands) const;
    void dispatchCut(const gpu::Recording& commands) const;

    VkDeviceSize bytes() const { return parts_.bytes() + cut_.bytes() + shown_.bytes(); }

private:
    gpu::Buffer parts_;
    gpu::Buffer cut_;
    gpu::Buffer counts_;
    gpu::Buffer shown_;
    std::uint32_t frame_ = 0; ///< so many have begun
};

} // namespace sward::render
