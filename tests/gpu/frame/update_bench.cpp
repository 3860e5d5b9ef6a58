#include "update_bench.h"

#include "gpu/memory/readback.h"
#include "gpu/memory/upload.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"
#include "render/frame/frame_time.h"
#include "shaders/shared/passes.h"

#include <cstring>
#include <limits>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::test {
namespace {

constexpr std::uint32_t everything = std::numeric_limits<std::uint32_t>::max();

render::BakedBlades upload(const gpu::DeviceContext& context, const field::FieldView& field,
                           std::uint32_t walkStart)
{
    gpu::Uploader uploader(context);
    render::BakedBlades blades(context, uploader, field, walkStart, 0);
    uploader.finish();
    return blades;
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
    , blades_(upload(context, field, settings.walkStart))
    , states_(context, blades_, {.before = false, .etas = true})
    , list_(context, blades_, everything, everything)
    , walk_(context, shaders_)
    , pass_(context)
    , tables_(context, {.name = "bench/tables",
                        .bytes = render::tableBytes(),
                        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        .memory = gpu::MemoryUse::constants})
{
    if (settings.recordCullResults)
        cullResults_ = gpu::Buffer(context, {.name = "bench/cull results",
                                             .bytes = blades_.placeCount() * sizeof(std::uint32_t),
                                             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
}

UpdateBench::Result UpdateBench::run(shared::Frame frame, const render::FrameSettings& settings,
                                     std::span<const shared::BladeState> states, float elapsed,
                                     render::UpdateCullPass::Scope scope,
                                     std::optional<double> frameTime)
{
    blades_.describe(frame);
    states_.describe(frame);
    list_.describe(frame);
    frame.cullResults = cullResults_.address();
    const double time = frameTime.value_or(timeOf(frame));
    render::writeTables(
        {tables_.mapped().data(), tables_.address()}, {}, settings,
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
    const gpu::Buffer constants(
        context_, {.name = "bench/frame",
                   .bytes = sizeof frame,
                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                   .memory = gpu::MemoryUse::constants});
    std::memcpy(constants.mapped().data(), &frame, sizeof frame);
    const gpu::UniformSets sets(
        context_, gpu::UniformSetLayout(context_, "frame"),
        {.name = "bench/frame", .buffer = constants.get(), .bytes = sizeof frame});
    const render::FramePlace place{constants.address(), sets.get(0)};

    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        states_.rest(commands, render::tickOf(time - static_cast<double>(elapsed)));
        list_.clear(commands);
        if (cullResults_.address() != 0)
            vkCmdFillBuffer(commands, cullResults_.get(), 0, VK_WHOLE_SIZE,
                            shared::cullResultPatch);
    });
    gpu::Uploader uploader(context_);
    std::vector<std::uint32_t> turns;
    std::vector<float> etas;
    for (const shared::BladeState& state : states) {
        turns.push_back(state.turn);
        etas.push_back(state.eta);
    }
    uploader.toBuffer(states_.states(), std::span<const std::uint32_t>(turns));
    uploader.toBuffer(states_.etas(), std::span<const float>(etas));
    uploader.finish();
    gpu::submitAndWait(context_, [&](VkCommandBuffer commands) {
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        if (scope == render::UpdateCullPass::Scope::visible)
            walk_.record(commands, blades_, list_, place.address);
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        render::UpdateCullPass::Input input{.frame = place};
        if (groups_ > 0) {
            input.maxGroups = groups_;
            vkCmdFillBuffer(commands, list_.levels().get(),
                            shared::visibleLevel * sizeof(shared::WalkLevel) +
                                offsetof(shared::WalkLevel, groups),
                            sizeof(std::uint32_t), groups_);
            gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
        }
        pass_.record(commands, blades_, list_, variant, scope, input);
    });

    Result result;
    const auto turned = gpu::readBufferAs<std::uint32_t>(context_, states_.states());
    const auto kept = gpu::readBufferAs<float>(context_, states_.etas());
    for (std::size_t i = 0; i < turned.size(); ++i)
        result.states.push_back({turned[i], kept[i]});
    if (cullResults_.bytes() > 0)
        result.cullResults = gpu::readBufferAs<std::uint32_t>(context_, cullResults_);
    result.visible = gpu::readBufferAs<shared::VisibleBlade>(context_, list_.visible());
    result.draw = gpu::readBufferAs<shared::DrawArguments>(context_, list_.draw())[0];
    result.nearColliders =
        gpu::readBufferAs<shared::WalkLevel>(context_, list_.levels()).back().count;
    result.visible.resize(result.draw.cullResults[shared::cullResultDrawn]);
    return result;
}

} // namespace sward::test
