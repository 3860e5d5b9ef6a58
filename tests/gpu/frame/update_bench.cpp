#include "update_bench.h"

#include "gpu/memory/readback.h"
#include "gpu/memory/upload.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"
#include "render/frame/frame_time.h"
#include "render/viewer/frame_slot.h"

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::test {
namespace {

render::FieldBuffers upload(const gpu::DeviceContext& context, const field::FieldView& field,
                            const render::FieldBuffers::Records& records)
{
    gpu::Uploader uploader(context);
    render::FieldBuffers buffers(context, uploader, field, records);
    uploader.finish();
    return buffers;
}

} // namespace

double timeOf(const shared::Frame& frame)
{
    return frame.tick / static_cast<double>(shared::ticksPerSecond);
}

UpdateBench::UpdateBench(const gpu::DeviceContext& context, const field::FieldView& field,
                         const Settings& settings)
    : context_(context)
    , groups_(settings.groups)
    , hasAllFeatures_(settings.hasAllFeatures)
    , shaders_(embedded::shaders())
    , buffers_(upload(context, field,
                      {.list = true,
                       .cullResults = settings.recordCullResults,
                       .etas = true,
                       .walkStart = settings.walkStart}))
    , walk_(context, shaders_)
    , pass_(context)
    , tables_(context)
{
}

UpdateBench::Result UpdateBench::run(shared::Frame frame, const render::FrameSettings& settings,
                                     std::span<const shared::BladeState> states, float elapsed,
                                     render::UpdateCullPass::Scope scope,
                                     std::optional<double> frameTime)
{
    buffers_.describe(frame);
    const double time = frameTime.value_or(timeOf(frame));
    tables_.write(
        {}, settings,
        render::collidersAt(settings.colliders, {}, time, time - static_cast<double>(elapsed)),
        time, frame);
    const render::UpdateCullPass::Variant variant{
        .windCounts = frame.environment.wind.counts,
        .hasColliders = frame.environment.colliderCount > 0,
        .keepsEtas = true,
        .features = hasAllFeatures_
                        ? shared::featureAll
                        : shared::featuresOf(frame.view, frame.pages != 0, frame.cullResults != 0,
                                             frame.organs.address != 0)};
    pass_.prepare(shaders_, variant);
    const render::FrameConstants constants(context_, gpu::UniformSetLayout(context_, "frame"),
                                           "frame");
    constants.fill(frame);

    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        buffers_.rest(commands, render::tickOf(time - static_cast<double>(elapsed)));
        buffers_.clearCounts(commands);
        buffers_.clearCullResults(commands);
    });
    gpu::Uploader uploader(context_);
    std::vector<std::uint32_t> turns;
    std::vector<float> etas;
    for (const shared::BladeState& state : states) {
        turns.push_back(state.turn);
        etas.push_back(state.eta);
    }
    uploader.toBuffer(buffers_.states(), std::span<const std::uint32_t>(turns));
    uploader.toBuffer(buffers_.etas(), std::span<const float>(etas));
    uploader.finish();
    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        if (scope == render::UpdateCullPass::Scope::visible)
            walk_.record(commands, buffers_.baked(), buffers_.list(), constants.place().address);
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        render::UpdateCullPass::Input input{.frame = constants.place()};
        if (groups_ > 0) {
            input.maxGroups = groups_;
            vkCmdFillBuffer(commands, buffers_.list().levels().get(),
                            shared::visibleLevel * sizeof(shared::WalkLevel) +
                                offsetof(shared::WalkLevel, groups),
                            sizeof(std::uint32_t), groups_);
            gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        }
        pass_.record(commands, buffers_.baked(), buffers_.list(), variant, scope, input);
    });

    Result result;
    const auto turned = gpu::readBufferAs<std::uint32_t>(context_, buffers_.states());
    const auto kept = gpu::readBufferAs<float>(context_, buffers_.etas());
    for (std::size_t i = 0; i < turned.size(); ++i)
        result.states.push_back({turned[i], kept[i]});
    if (buffers_.cullResults().bytes() > 0)
        result.cullResults = gpu::readBufferAs<std::uint32_t>(context_, buffers_.cullResults());
    result.visible = gpu::readBufferAs<shared::VisibleBlade>(context_, buffers_.visible());
    result.draw = gpu::readBufferAs<shared::DrawArguments>(context_, buffers_.draw())[0];
    result.nearColliders =
        gpu::readBufferAs<shared::WalkLevel>(context_, buffers_.list().levels()).back().count;
    result.visible.resize(result.draw.cullResults[shared::cullResultDrawn]);
    return result;
}

} // namespace sward::test
