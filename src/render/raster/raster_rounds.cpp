#include "render/raster/raster_rounds.h"

#include "gpu/recording/barrier.h"
#include "render/cull/pass_scope.h"

namespace sward::render {

void RasterRounds::record(const gpu::Recording& commands, const RasterPass::Input& input,
                          gpu::Timestamps* timestamps) const
{
    using Phase = RasterPass::Phase;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        recordFirst(commands, input, round, timestamps);
        if (!input.findsHidden)
            continue;
        // The first round has most visible patches: its blades hide the rest.
        if (round == 0)
            recordPyramid(commands, input, timestamps);
        gpu::computeToCompute(commands);
        const DispatchScope scope(context, commands, timestamps, "blades");
        raster.recordBlades(commands, input, round, Phase::late);
    }
    gpu::computeToCompute(commands);
    const DispatchScope scope(context, commands, timestamps, "blades");
    raster.recordLarge(commands, input, input.findsHidden ? Phase::late : Phase::early);
}

void RasterRounds::recordFirst(const gpu::Recording& commands, const RasterPass::Input& input,
                               std::uint32_t round, gpu::Timestamps* timestamps) const
{
    // The round before reads the list that is rewritten now.
    if (round > 0)
        gpu::computeToCompute(commands);
    using Shown = UpdateCullPass::Shown;
    blades.moveAndList(commands, input.cullView, round,
                       input.findsHidden ? raster.shown() : Shown(), timestamps);
    gpu::computeToCompute(commands);
    const DispatchScope scope(context, commands, timestamps, "blades");
    raster.recordBlades(commands, input, round, RasterPass::Phase::early);
}

void RasterRounds::recordPyramid(const gpu::Recording& commands, const RasterPass::Input& input,
                                 gpu::Timestamps* timestamps) const
{
    gpu::computeToCompute(commands);
    {
        const DispatchScope scope(context, commands, timestamps, "blades");
        raster.recordLarge(commands, input, RasterPass::Phase::early);
    }
    gpu::memoryBarrier(commands, gpu::dispatchAccess, gpu::dispatchAccess);
    const DispatchScope scope(context, commands, timestamps, "pyramid");
    raster.recordDepths(commands, input, RasterPass::Levels::finest);
}

} // namespace sward::render
