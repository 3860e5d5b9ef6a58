#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/image_set.h"
#include "gpu/recording.h"
#include "gpu/sampler.h"
#include "gpu/shader_library.h"
#include "shaders/shared/frame.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The cells of a depth pyramid, and the picture that they are filled from.
struct DepthCells {
    shared::DepthPyramid layout = {};
    gpu::Buffer depths;
    gpu::ImageSet picture;

    VkDeviceSize bytes() const { return depths.bytes(); }
};

/// Finds the farthest depths of what has been drawn, in ever coarser cells: what hides what.
class PyramidPass {
public:
    /// How depths are given. `samples`: 1, 2, 4 or 8 per pixel. `slack` is by how much what has
    /// been drawn may be farther than its depth says.
    struct Settings {
        std::uint32_t samples = 1;
        bool hasReversedZ = true;
        float slack = 0.0f;
    };

    PyramidPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                const Settings& settings);

    /// Makes cells for pictures of so many pixels unless they are that many, which somebody else
    /// fills. The device is done with the former ones.
    void fit(DepthCells& cells, glm::uvec2 size) const;

    /// Makes cells for a depth picture of so many pixels, which is in `layout` when record() runs.
    /// The device is done with what the cells were for before.
    void fit(DepthCells& cells, VkImageView depth, VkImageLayout layout, glm::uvec2 size) const;

    /// Fills them, between barriers from the drawing of depth and to compute shaders. The frame
    /// knows their layout.
    void record(const gpu::Recording& commands, const DepthCells& cells,
                VkDeviceAddress frame) const;

private:
    const gpu::DeviceContext* context_;
    float slack_;
    gpu::ImageSetLayout imageLayout_;
    gpu::Sampler sampler_;
    gpu::ComputePipeline first_;
    gpu::ComputePipeline rest_;
};

} // namespace sward::render
