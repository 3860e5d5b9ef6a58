#include "render/depth_pyramid.h"

#include "core/expect.h"
#include "gpu/barrier.h"
#include "shaders/shared/passes.h"

namespace sward::render {
namespace {

std::uint32_t groupsFor(std::uint32_t cells)
{
    return (cells + shared::pyramidThreads - 1) / shared::pyramidThreads;
}

} // namespace

DepthPyramid::DepthPyramid(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                           std::uint32_t samples)
    : context_(&context)
    , imageLayout_(
          context,
          {.name = "pyramid/depth", .sampledCount = 1, .stages = VK_SHADER_STAGE_COMPUTE_BIT})
    , sampler_(gpu::createSampler(context, {.name = "pyramid",
                                            .filter = VK_FILTER_NEAREST,
                                            .address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}))
    , first_(context, shaders,
             {.name = "pyramid/first",
              .shader = samples > 1 ? "pyramid_first_of_four.comp" : "pyramid_first.comp",
              .pushConstantBytes = sizeof(shared::PyramidPush),
              .setLayouts = {imageLayout_.get()}})
    , next_(context, shaders,
            {.name = "pyramid/next",
             .shader = "pyramid_next.comp",
             .pushConstantBytes = sizeof(shared::PyramidPush)})
{
}

void DepthPyramid::resize(const gpu::Image& depth)
{
    layout_ = {};
    layout_.size = {depth.extent().width, depth.extent().height};
    std::uint32_t cells = 0;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    do {
        expect(layout_.levels < shared::maxPyramidLevels, "a picture is no wider than a device's");
        columns = shared::pyramidCells(layout_.size.x, layout_.levels);
        rows = shared::pyramidCells(layout_.size.y, layout_.levels);
        layout_.first[layout_.levels++] = cells;
        cells += columns * rows;
    } while (columns > 1 || rows > 1);

    bytes_ = cells * sizeof(float);
    depths_ = gpu::Buffer(*context_, {.name = "frame/depth pyramid",
                                      .bytes = bytes_,
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
    layout_.depths = depths_.address();
    image_ = gpu::ImageSet(*context_, imageLayout_, "pyramid/depth");
    image_.setSampled(0, depth.view(), sampler_.get());
}

void DepthPyramid::record(VkCommandBuffer commands, VkDeviceAddress frame) const
{
    first_.bind(commands);
    image_.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, first_.layout());
    for (std::uint32_t level = 0; level < layout_.levels; ++level) {
        const gpu::ComputePipeline& pipeline = level == 0 ? first_ : next_;
        if (level == 1)
            next_.bind(commands);
        if (level > 0)
            gpu::computeToCompute(commands);
        pipeline.push(commands, shared::PyramidPush{frame, level, 0});
        vkCmdDispatch(commands, groupsFor(shared::pyramidCells(layout_.size.x, level)),
                      groupsFor(shared::pyramidCells(layout_.size.y, level)), 1);
    }
}

} // namespace sward::render
