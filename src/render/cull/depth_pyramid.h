#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/cull/pyramid_pass.h"
#include "shaders/shared/frame.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The depth pyramid (farthest depths) of a renderer's own picture.
class DepthPyramid {
public:
    /// `samples`: per pixel of the depth picture. `readsPicture`: record() fills the pyramid from
    /// it; else RasterPass::recordDepths() does, and no pipeline is made.
    DepthPyramid(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                 std::uint32_t samples, bool readsPicture)
        : pass_(context, {.samples = samples})
    {
        if (readsPicture)
            pass_.prepare(shaders);
    }

    /// Fits the pyramid to a depth picture, which is in ImageUse::sampled when record() runs. The
    /// device must be done with the former one.
    void resize(const gpu::Image& depth)
    {
        pass_.fit(cells_, depth.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                  {depth.extent().width, depth.extent().height});
    }

    /// The same for a pyramid that RasterPass::recordDepths() fills.
    void resize(VkExtent2D size) { pass_.fit(cells_, glm::uvec2(size.width, size.height)); }

    /// Writes its layout and address into a frame.
    void describe(shared::Frame& frame) const { frame.pyramid = cells_.layout; }

    /// Fills it. Needs barriers from depth writes before, and to compute shaders after.
    void record(const gpu::Recording& commands, VkDeviceAddress frame) const
    {
        pass_.record(commands, cells_, frame);
    }

    VkDeviceSize bytes() const { return cells_.bytes(); }

private:
    PyramidPass pass_;
    DepthCells cells_;
};

} // namespace sward::render
