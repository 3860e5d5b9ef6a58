#pragma once

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The blades that cover many pixels, as the rasteriser lists them: shared::LargePart, how many
/// have been asked for, and what dispatches or draws those that are listed.
class LargeBladeList {
public:
    LargeBladeList() = default;

    /// For what there is room beside shared::mostCutBlades.
    struct Room {
        bool large = false;            ///< shared::mostLargeParts
        std::uint32_t shownBlades = 0; ///< two bits each, if some are to be left out as hidden
    };

    LargeBladeList(const gpu::DeviceContext& context, Room room);

    void describe(shared::RasterPush& push) const; ///< where shaders find all but those bits

    /// Two bits for each blade: see shared::RasterPush::seen.
    VkDeviceAddress shown() const { return shown_.address(); }

    /// Empties it; a transfer.
    void clear(VkCommandBuffer commands) const;

    /// Keeps what is listed, and how much that is as drawn in the first turn; but those that the
    /// near plane cuts have been drawn for good. A transfer.
    void beginLate(VkCommandBuffer commands) const;

    /// Before the first frame no blade has been shown; a transfer, once.
    void beginShown(VkCommandBuffer commands);

    void dispatch(VkCommandBuffer commands) const;    ///< work-groups for all that are listed …
    void dispatchCut(VkCommandBuffer commands) const; ///< … but the cut ones, and for these

    /// Of VkDrawIndirectCommand, a vertex for each that is listed.
    VkBuffer drawBuffer() const { return counts_.get(); }
    static VkDeviceSize drawOffset();

    VkDeviceSize bytes() const { return parts_.bytes() + cut_.bytes() + shown_.bytes(); }

private:
    gpu::Buffer parts_;
    gpu::Buffer cut_;
    gpu::Buffer counts_;
    gpu::Buffer shown_;
    bool hasShown_ = false; ///< whether it has been filled
};

} // namespace sward::render
