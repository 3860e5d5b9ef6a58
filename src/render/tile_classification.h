#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Lists of a picture's tiles: see shaders/shared/tile_classification.h.
class TileClassification {
public:
    /// `samples`: 1 or 4 per pixel. `sorts`: whether record() fills the lists of what tiles show.
    TileClassification(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       std::uint32_t samples, bool sorts);

    /// Has pictures of this size; the device is done with the former ones.
    void resize(VkExtent2D size);

    /// Empties the lists; a transfer.
    void clear(VkCommandBuffer commands) const;

    /// Sorts what the visibility shows. Before come barriers from that transfer and from whoever
    /// has drawn, after it one to dispatches.
    void record(VkCommandBuffer commands, const shared::RasterPush& push) const;

    /// A work-group for each tile of a list, of shared::tilesOfOpaque … ; between barriers to
    /// dispatches and from compute shaders.
    void dispatch(VkCommandBuffer commands, std::uint32_t list) const;

    VkDeviceAddress address() const { return lists_.address(); }
    VkDeviceSize bytes() const { return lists_.bytes(); }

private:
    const gpu::DeviceContext* context_;
    gpu::ComputePipeline sort_;
    std::uint32_t groups_ = 0; ///< that sort
    gpu::Buffer lists_;
};

} // namespace sward::render
