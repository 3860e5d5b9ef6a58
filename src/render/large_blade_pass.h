#pragma once

#include "gpu/context.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/shader_library.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Why the graphics pipeline cannot draw into a visibility buffer of so many samples a pixel; null
/// if it can.
const char* obstacleToLargeBlades(const gpu::DeviceContext& context, std::uint32_t samples);

/// Draws the large blades that the rasteriser has listed by tessellation, sample by sample into the
/// visibility. There they meet the others before anything is shaded, so that no seam can be seen.
class LargeBladePass {
public:
    /// `obstacleToLargeBlades()` has none.
    LargeBladePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                   std::uint32_t samples);

    /// Between barriers from and to compute shaders. `draw` holds a VkDrawIndirectCommand at
    /// `offset` [bytes].
    void record(VkCommandBuffer commands, const shared::RasterPush& push, VkBuffer draw,
                VkDeviceSize offset) const;

private:
    gpu::GraphicsPipeline pipeline_;
};

} // namespace sward::render
