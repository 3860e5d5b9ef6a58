#include "render/preview/ground_cull_pass.h"

#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

#include <algorithm>

namespace sward::render {
namespace {

/// From the number of draws of a part to the next [bytes]: shaders' buffers begin at multiples
/// of 8.
constexpr VkDeviceSize countStride = 8;

std::uint32_t groupsOf(std::uint32_t clusters)
{
    return static_cast<std::uint32_t>(gpu::groupsFor(clusters, shared::groundThreads));
}

} // namespace

GroundCullPass::GroundCullPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                               const GroundBuffers& ground)
    : ground_(&ground)
{
    const auto pipeline = [&](const char* name, bool writesDraws) {
        return gpu::ComputePipeline(
            context, shaders,
            {.name = name,
             .shader = shader::cullGround,
             .pushConstantBytes = sizeof(shared::GroundCullPush),
             .constants = {{.id = shared::idWritesDraws, .value = writesDraws}}});
    };
    const auto buffer = [&](const char* name, VkDeviceSize bytes) {
        return gpu::Buffer(context, {.name = name,
                                     .bytes = bytes,
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                              VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT});
    };
    std::uint32_t largest = 0;
    for (const GroundBuffers::Part& part : ground.parts())
        largest = std::max(largest, part.isDrawnWhole ? 0 : part.clusterCount);
    if (largest == 0)
        return;
    find_ = pipeline("ground/seen", false);
    write_ = pipeline("ground/draws", true);
    draws_ = buffer("ground/draws", ground.clusterCount() * sizeof(shared::IndexedDraw));
    seen_ = buffer("ground/seen", groupsOf(largest) * shared::groundWords * sizeof(std::uint32_t));
    counts_ = buffer("ground/draw counts", ground.parts().size() * countStride);
}

void GroundCullPass::record(const gpu::Recording& commands, VkDeviceAddress frame) const
{
    if (draws_.bytes() == 0)
        return;
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::computeAccess);
    for (const GroundBuffers::Part& part : ground_->parts()) {
        if (part.isDrawnWhole)
            continue;
        const shared::GroundCullPush push{
            .frame = frame,
            .clusters = ground_->clusters() + part.firstCluster * sizeof(shared::GroundCluster),
            .draws = draws_.address(),
            .seen = seen_.address(),
            .drawCount = counts_.address() + part.place * countStride,
            .clusterCount = part.clusterCount,
            .firstCluster = part.firstCluster};
        find_.bind(commands);
        find_.push(commands, push);
        commands.vk->CmdDispatch(commands, groupsOf(part.clusterCount), 1, 1);
        gpu::computeToCompute(commands);
        write_.bind(commands);
        write_.push(commands, push);
        commands.vk->CmdDispatch(commands, groupsOf(part.clusterCount), 1, 1);
        // The next part reuses the bits.
        gpu::computeToCompute(commands);
    }
    gpu::computeToDraw(commands);
}

void GroundCullPass::draw(const gpu::Recording& commands, const GroundBuffers::Part& part) const
{
    if (part.isDrawnWhole)
        commands.vk->CmdDrawIndexed(commands, part.indexCount, 1, part.firstIndex, 0, 0);
    else
        commands.vk->CmdDrawIndexedIndirectCount(
            commands, draws_.get(), part.firstCluster * sizeof(shared::IndexedDraw), counts_.get(),
            part.place * countStride, part.clusterCount, sizeof(shared::IndexedDraw));
}

} // namespace sward::render
