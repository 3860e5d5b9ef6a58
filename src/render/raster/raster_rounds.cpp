#include "render/raster/raster_rounds.h"

#include "gpu/recording/barrier.h"
#include "render/cull/pass_scope.h"

namespace sward::render {

void RasterRounds::record(const gpu::Recording& commands, gpu::Timestamps* timestamps) const
{
    using Phase = RasterPass::Phase;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        recordFirst(commands, round, timestamps);
        if (!hasTwoPasses)
            continue;
        // The first round has most visible patches: its blades hide the rest.
        if (round == 0)
            recordEarlyLarge(commands, timestamps);
        gpu::computeToCompute(commands);
        const DispatchScope scope(context, commands, timestamps, "blades");
        pass.recordBlades(commands, view, round, Phase::late);
    }
    gpu::computeToCompute(commands);
    const DispatchScope scope(context, commands, timestamps, "blades");
    pass.recordLarge(commands, view, hasTwoPasses ? Phase::late : Phase::early);
}

void RasterRounds::recordFirst(const gpu::Recording& commands, std::uint32_t round,
                               gpu::Timestamps* timestamps) const
{
    if (list) {
        // The round before reads the list that is rewritten now.
        if (round > 0)
            gpu::computeToCompute(commands);
        list(round);
        gpu::computeToCompute(commands);
    }
    const DispatchScope scope(context, commands, timestamps, "blades");
    pass.recordBlades(commands, view, round, RasterPass::Phase::early);
}

void RasterRounds::recordEarlyLarge(const gpu::Recording& commands,
                                    gpu::Timestamps* timestamps) const
{
    gpu::computeToCompute(commands);
    {
        const DispatchScope scope(context, commands, timestamps, "blades");
        pass.recordLarge(commands, view, RasterPass::Phase::early);
        // Blades in the visibility history are likely visible. Dispatches as many work-groups as
        // listed blades; they store into the shading cache.
        const RasterPass::Instance& instance = view.instances.front();
        if (shadingCache != nullptr)
            ShadingCachePass::record(commands, *shadingCache, instance.push, instance.frame,
                                     instance.list->rounds().get());
    }
    gpu::memoryBarrier(commands, gpu::dispatchAccess, gpu::dispatchAccess);
    const DispatchScope scope(context, commands, timestamps, "pyramid");
    pass.recordDepths(commands, view, RasterPass::Levels::finest);
}

} // namespace sward::render
