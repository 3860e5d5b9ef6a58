#pragma once

#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/shader_library.h"
#include "render/pyramid_pass.h"
#include "shaders/shared/frame.h"

#include <glm/glm.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <utility>

namespace sward::render {

/// The farthest depths of a renderer's own picture.
class DepthPyramid {
public:
    /// `samples`: of the depth picture.
    DepthPyramid(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                 std::uint32_t samples)
        : pass_(context, shaders, {.samples = samples})
        , keepsBefore_(samples > 1)
    {
    }

    /// Has room for this depth picture, of ImageUse::sampled when record() runs. The device is done
    /// with the former one.
    void resize(const gpu::Image& depth)
    {
        pass_.fit(cells_, depth.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                  {depth.extent().width, depth.extent().height});
    }

    /// The same where RasterPass::recordDepths() fills it.
    void resize(VkExtent2D size)
    {
        pass_.fit(cells_, glm::uvec2(size.width, size.height));
        if (keepsBefore_)
            pass_.fit(before_, glm::uvec2(size.width, size.height));
        holdsBlades_ = false;
    }

    /// Begins a frame. If blades have two turns in it and had them in the frame before, with a
    /// camera that stood where it stands now, the finest levels of that are kept, of several
    /// samples.
    void begin(bool hasTurns, const glm::mat4& viewProjection)
    {
        if (!keepsBefore_)
            return;
        if (hasTurns)
            std::swap(cells_, before_);
        knowsBefore_ = hasTurns && holdsBlades_ && showsAlike(viewProjection, viewProjection_);
        holdsBlades_ = hasTurns;
        viewProjection_ = viewProjection;
    }

    /// Writes where it lies into a frame.
    void describe(shared::Frame& frame) const
    {
        frame.pyramid = cells_.layout;
        frame.depthsBefore = knowsBefore_ ? before_.layout.depths : 0;
    }

    /// Fills it, between barriers from the drawing of depth and to compute shaders.
    void record(VkCommandBuffer commands, VkDeviceAddress frame) const
    {
        pass_.record(commands, cells_, frame);
    }

    VkDeviceSize bytes() const { return cells_.bytes() + before_.bytes(); }

private:
    /// Whether what stands a metre away, or farther, is seen within a pixel or so of the same
    /// place.
    static bool showsAlike(const glm::mat4& a, const glm::mat4& b)
    {
        for (int column = 0; column < 4; ++column)
            if (glm::any(glm::greaterThan(glm::abs(a[column] - b[column]), glm::vec4(5e-4f))))
                return false;
        return true;
    }

    PyramidPass pass_;
    DepthCells cells_;
    bool keepsBefore_;
    DepthCells before_;        ///< of the frame before
    bool holdsBlades_ = false; ///< cells_
    bool knowsBefore_ = false;
    glm::mat4 viewProjection_{0.0f}; ///< of the frame that has begun last
};

} // namespace sward::render
