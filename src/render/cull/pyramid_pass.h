#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/image_set.h"
#include "gpu/pipeline/sampler.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "shaders/shared/frame.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The cells of a depth pyramid, and the depth picture that fills them.
struct DepthCells {
    shared::DepthPyramid layout = {};
    gpu::Buffer depths;
    gpu::ImageSet picture;

    VkDeviceSize bytes() const { return depths.bytes(); }
};

/// Computes farthest depths in successively coarser cells, for occlusion tests.
class PyramidPass {
public:
    /// Format of depths. `samples`: 1, 2, 4 or 8 per pixel. `slack`: how much farther the drawn
    /// surface may be than its depth says.
    struct Settings {
        std::uint32_t samples = 1;
        bool hasReversedZ = true;
        float slack = 0.0f;
    };

    PyramidPass(const gpu::DeviceContext& context, const Settings& settings);

    /// Makes the pipelines, unless they exist. For record(): cells that another pass fills need
    /// none.
    void prepare(const gpu::ShaderLibrary& shaders);

    /// Makes cells for pictures of `size` pixels unless they fit already; another pass fills them.
    /// The device must be done with the former ones.
    void fit(DepthCells& cells, glm::uvec2 size) const;

    /// Makes cells for a depth picture of `size` pixels, which is in `layout` when record() runs.
    /// The device must be done with the cells' former use.
    void fit(DepthCells& cells, VkImageView depth, VkImageLayout layout, glm::uvec2 size) const;

    /// Fills the cells. Needs barriers from depth writes before and to compute shaders after. The
    /// frame contains their layout.
    void record(const gpu::Recording& commands, const DepthCells& cells,
                VkDeviceAddress frame) const;

private:
    const gpu::DeviceContext* context_;
    Settings settings_;
    gpu::ImageSetLayout imageLayout_;
    gpu::Sampler sampler_;
    gpu::ComputePipeline first_;
    gpu::ComputePipeline rest_;
};

} // namespace sward::render
