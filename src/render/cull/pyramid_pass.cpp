#include "render/cull/pyramid_pass.h"

#include "core/expect.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

namespace sward::render {
namespace {

std::uint32_t groupsFor(std::uint32_t cells)
{
    return (cells + shared::pyramidThreads - 1) / shared::pyramidThreads;
}

/// Sets the layout of a pyramid's cells except their address; returns the number of cells.
std::uint32_t layOut(glm::uvec2 size, shared::DepthPyramid& layout)
{
    layout = {};
    layout.size = size;
    std::uint32_t cells = 0;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    do {
        expect(layout.levels < shared::maxPyramidLevels, "a picture is no wider than a device's");
        columns = shared::pyramidCells(layout.size.x, layout.levels);
        rows = shared::pyramidCells(layout.size.y, layout.levels);
        layout.first[layout.levels++] = cells;
        cells += columns * rows;
    } while (columns > 1 || rows > 1);
    return cells;
}

} // namespace

PyramidPass::PyramidPass(const gpu::DeviceContext& context, const Settings& settings)
    : context_(&context)
    , settings_(settings)
    , imageLayout_(
          context,
          {.name = "pyramid/depth", .sampledCount = 1, .stages = VK_SHADER_STAGE_COMPUTE_BIT})
    , sampler_(gpu::createSampler(context, {.name = "pyramid",
                                            .filter = VK_FILTER_NEAREST,
                                            .address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}))
{
}

void PyramidPass::prepare(const gpu::ShaderLibrary& shaders)
{
    if (first_.get() != VK_NULL_HANDLE)
        return;
    first_ = gpu::ComputePipeline(
        *context_, shaders,
        {.name = "pyramid/first",
         .shader = settings_.samples > 1 ? shader::pyramidFirstOfSeveral : shader::pyramidFirst,
         .pushConstantBytes = sizeof(shared::PyramidPush),
         .setLayouts = {imageLayout_.get()},
         .constants = {{.id = shared::idHasForwardZ, .value = settings_.hasReversedZ ? 0u : 1u},
                       {.id = shared::idSamplesPerPixel, .value = settings_.samples}}});
    rest_ = gpu::ComputePipeline(*context_, shaders,
                                 {.name = "pyramid/rest",
                                  .shader = shader::pyramidRest,
                                  .pushConstantBytes = sizeof(shared::ViewPush)});
}

void PyramidPass::fit(DepthCells& cells, glm::uvec2 size) const
{
    if (cells.depths.get() != VK_NULL_HANDLE && cells.layout.size == size)
        return;
    const std::uint32_t count = layOut(size, cells.layout);
    cells.depths = gpu::Buffer(*context_, {.name = "frame/depth pyramid",
                                           .bytes = count * sizeof(float),
                                           .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
    cells.layout.depths = cells.depths.address();
    cells.picture = gpu::ImageSet(*context_, imageLayout_, "pyramid/depth");
}

void PyramidPass::fit(DepthCells& cells, VkImageView depth, VkImageLayout layout,
                      glm::uvec2 size) const
{
    fit(cells, size);
    cells.picture.setSampled(0, depth, sampler_.get(), layout);
}

void PyramidPass::record(const gpu::Recording& commands, const DepthCells& cells,
                         VkDeviceAddress frame) const
{
    first_.bind(commands);
    cells.picture.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, first_.layout());
    first_.push(commands,
                shared::PyramidPush{.frame = frame, .slack = settings_.slack, .reserved = 0});
    commands.vk->CmdDispatch(commands, groupsFor(shared::pyramidCells(cells.layout.size.x, 0)),
                             groupsFor(shared::pyramidCells(cells.layout.size.y, 0)), 1);
    if (cells.layout.levels <= shared::pyramidFirstOfRest)
        return;
    gpu::computeToCompute(commands);
    rest_.bind(commands);
    rest_.push(commands, shared::ViewPush{frame});
    commands.vk->CmdDispatch(commands, 1, 1, 1);
}

} // namespace sward::render
