#include "render/cull/moving_blades.h"

#include "core/expect.h"
#include "gpu/recording/barrier.h"
#include "render/cull/pass_scope.h"
#include "render/frame/frame_time.h"

#include <utility>

namespace sward::render {

MovingBlades::MovingBlades(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                           FieldBuffers buffers, bool testsSmall)
    : context_(&context)
    , buffers_(std::move(buffers))
    , walk_(context, shaders)
    , update_(context)
    , testsSmall_(testsSmall)
{
}

void MovingBlades::expectEdits(const gpu::ShaderLibrary& shaders,
                               std::unique_ptr<EditedField> edited, GrassCover& cover,
                               std::uint32_t framesInFlight)
{
    edits_.emplace(*context_, shaders, std::move(edited), cover, framesInFlight);
    replaced_.emplace(framesInFlight);
}

void MovingBlades::apply(const field::Delta& delta)
{
    edits_->apply(delta);
    buffers_.update(*context_, edits_->field(), delta, replaced_->waiting());
}

void MovingBlades::prepare(const gpu::ShaderLibrary& shaders, const shared::Frame& frame)
{
    expect(frame.environment.colliderCount == 0 || buffers_.hasEtas(), "collisions can be kept");
    variant_ = {.windCounts = frame.environment.wind.counts,
                .hasColliders = frame.environment.colliderCount > 0,
                .keepsEtas = buffers_.hasEtas(),
                .testsSmall = testsSmall_,
                .features = shared::featuresOf(frame.view, frame.pages != 0, frame.cullResults != 0,
                                               frame.organs.address != 0)};
    update_.prepare(shaders, variant_);
}

void MovingBlades::expectColliders()
{
    if (buffers_.hasEtas())
        return;
    buffers_.keepEtas(*context_);
    hasNewEtas_ = true;
}

void MovingBlades::begin(const gpu::Recording& commands, double time, std::uint32_t slot)
{
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
    if (replaced_)
        replaced_->record(commands, slot);
    buffers_.clearCounts(commands);
    buffers_.clearCullResults(commands);
    const std::uint32_t settledAt = settledTick(time);
    // Treats every blade as settled: none is still moving from the straight pose of the bake.
    if (!hasMoved_)
        buffers_.rest(commands, settledAt);
    else if (!movesOn(movedTo_, time))
        buffers_.settle(commands, settledAt);
    if (hasMoved_ && hasNewEtas_)
        buffers_.clearEtas(commands);
    hasMoved_ = true;
    movedTo_ = time;
    hasNewEtas_ = false;
    const BladeStates* const states = &buffers_.ownStates();
    if (edits_)
        edits_->record(commands, buffers_.baked(), {&states, 1}, settledAt, slot);
    gpu::transferToCompute(commands);
}

void MovingBlades::beginAgain(const gpu::Recording& commands) const
{
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::transferAccess);
    buffers_.clearCounts(commands);
    gpu::transferToCompute(commands);
}

void MovingBlades::findVisiblePatches(const gpu::Recording& commands, VkDeviceAddress cullView,
                                      gpu::Timestamps* timestamps) const
{
    const DispatchScope scope(*context_, commands, timestamps, "cull");
    walk_.record(commands, buffers_.baked(), buffers_.list(), cullView);
    gpu::computeToCompute(commands);
}

void MovingBlades::moveAndList(const gpu::Recording& commands, const FramePlace& cullView,
                               std::uint32_t round, UpdateCullPass::History history,
                               gpu::Timestamps* timestamps) const
{
    const DispatchScope scope(*context_, commands, timestamps, "update");
    update_.record(commands, buffers_.baked(), buffers_.list(), variant_,
                   UpdateCullPass::Scope::visible,
                   {.frame = cullView, .round = round, .history = history});
}

void MovingBlades::moveAll(const gpu::Recording& commands, const FramePlace& frame) const
{
    update_.record(commands, buffers_.baked(), buffers_.list(), variant_,
                   UpdateCullPass::Scope::all, {.frame = frame});
}

} // namespace sward::render
