#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/recording/recording.h"
#include "render/cull/update_cull_pass.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The rasteriser's list of blades that cover many pixels: shared::LargePart, the requested number,
/// and the arguments of indirect dispatches.
class LargeBladeList {
public:
    LargeBladeList() = default;

    /// Optional storage, besides shared::maxCutBlades.
    struct Room {
        bool large = false; ///< shared::maxLargeParts
        std::uint32_t shownBlades =
            0; ///< visibility history: bits per quarter; 0: no occlusion test
    };

    LargeBladeList(const gpu::DeviceContext& context, Room room);

    void describe(shared::RasterPush& push) const; ///< addresses except the history

    /// The visibility history, a bit per quarter of each blade: see shared::RasterPush::seen.
    UpdateCullPass::Shown shown() const { return {shown_.address(), frame_}; }

    /// Makes room for more blades in the history, which is empty then. Returns the former buffer.
    gpu::Buffer growShown(const gpu::DeviceContext& context, std::uint32_t blades);
    bool hasRoomFor(std::uint32_t blades) const; ///< in the history, if there is one

    /// Clears the list; a transfer.
    void clear(const gpu::Recording& commands) const;

    /// Begins a frame. Clears a new visibility history; a transfer.
    void beginShown(const gpu::Recording& commands);

    // Dispatch work-groups for large parts in the early pass, large parts in the late pass, and
    // blades cut by the near plane.
    void dispatch(const gpu::Recording& commands) const;
    void dispatchLate(const gpu::Recording& commands) const;
    void dispatchCut(const gpu::Recording& commands) const;

    VkDeviceSize bytes() const { return parts_.bytes() + cut_.bytes() + shown_.bytes(); }

private:
    gpu::Buffer parts_;
    gpu::Buffer cut_;
    gpu::Buffer counts_;
    gpu::Buffer shown_;
    bool isCleared_ = false;
    std::uint32_t frame_ = 0; ///< number of frames begun
};

} // namespace sward::render
