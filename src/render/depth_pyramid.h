#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/image_set.h"
#include "gpu/sampler.h"
#include "gpu/shader_library.h"
#include "shaders/shared/frame.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The farthest depths of what has been drawn, in ever coarser cells: what hides what.
class DepthPyramid {
public:
    /// `samples`: of the depth picture, 1 or 4.
    DepthPyramid(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                 std::uint32_t samples);

    /// Has room for this depth picture, of ImageUse::sampled when record() runs. The device is done
    /// with the former one.
    void resize(const gpu::Image& depth);

    /// Writes where it lies into a frame.
    void describe(shared::Frame& frame) const { frame.pyramid = layout_; }

    /// Fills it, between barriers from the drawing of depth and to compute shaders.
    void record(VkCommandBuffer commands, VkDeviceAddress frame) const;

    VkDeviceSize bytes() const { return bytes_; }

private:
    const gpu::DeviceContext* context_;
    gpu::ImageSetLayout imageLayout_;
    gpu::Sampler sampler_;
    gpu::ComputePipeline first_;
    gpu::ComputePipeline next_;
    gpu::ImageSet image_;
    gpu::Buffer depths_;
    shared::DepthPyramid layout_ = {};
    VkDeviceSize bytes_ = 0;
};

} // namespace sward::render
