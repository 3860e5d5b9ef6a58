#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Lists of a picture's tiles by content: see shaders/shared/tile_classification.h.
class TileClassification {
public:
    /// `samples`: 1 or 4 per pixel. `sorts`: whether record() fills the lists by content.
    TileClassification(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       std::uint32_t samples, bool sorts);

    /// Resizes the lists; the device must be done with the former ones.
    void resize(VkExtent2D size);

    /// Clears the lists; a transfer.
    void clear(const gpu::Recording& commands) const;

    /// Classifies the visibility's tiles. Needs barriers from clear() and from the drawing passes
    /// before, and one to dispatches after.
    void record(const gpu::Recording& commands, const shared::RasterPush& push) const;

    /// Dispatches a work-group per tile of a list, shared::tilesOfOpaque …. Needs barriers to
    /// dispatches before and from compute shaders after.
    void dispatch(const gpu::Recording& commands, std::uint32_t list) const;

    VkDeviceAddress address() const { return lists_.address(); }
    VkDeviceSize bytes() const { return lists_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    gpu::ComputePipeline sort_;
    std::uint32_t groups_ = 0; ///< work-groups that sort
    gpu::Buffer lists_;
};

} // namespace sward::render
