#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/recording/recording.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// The rasteriser's list of blades that cover many pixels: shared::LargePart, the requested number,
/// and the arguments of indirect dispatches.
class LargeBladeList {
public:
    LargeBladeList() = default;

    /// `hasLarge`: room for shared::maxLargeParts, besides shared::maxCutBlades.
    LargeBladeList(const gpu::DeviceContext& context, bool hasLarge);

    void describe(shared::RasterPush& push) const;

    /// Clears the list; a transfer.
    void clear(const gpu::Recording& commands) const;

    // Dispatch work-groups for large parts in the early pass, large parts in the late pass, and
    // blades cut by the near plane.
    void dispatch(const gpu::Recording& commands) const;
    void dispatchLate(const gpu::Recording& commands) const;
    void dispatchCut(const gpu::Recording& commands) const;

    VkDeviceSize bytes() const { return parts_.bytes() + cut_.bytes(); }

private:
    gpu::Buffer parts_;
    gpu::Buffer cut_;
    gpu::Buffer counts_;
};

} // namespace sward::render
