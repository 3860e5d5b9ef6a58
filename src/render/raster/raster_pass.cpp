#include "render/raster/raster_pass.h"

#include "core/expect.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"

#include <vector>

namespace sward::render {
namespace {

/// Descriptor set of the frame.
constexpr std::uint32_t frameSet = 0;

struct StageShader {
    const char* name;
    const char* module;
    bool isOfInstances = false;
};

StageShader shaderOf(RasterPass::Stage stage)
{
    using Stage = RasterPass::Stage;
    switch (stage) {
    case Stage::blades:
        return {"raster/blades", shader::rasterBlades};
    case Stage::lateBlades:
        return {"raster/late blades", shader::listLate};
    case Stage::large:
        return {"raster/large blades", shader::rasterLarge};
    case Stage::lateLarge:
        return {"raster/late large blades", shader::rasterLate};
    case Stage::cut:
        return {"raster/cut blades", shader::rasterCut};
    case Stage::depths:
        return {"raster/depths", shader::seenDepths};
    case Stage::allDepths:
        return {"raster/all depths", shader::seenDepths};
    case Stage::largeOfInstances:
        return {"raster/large blades of instances", shader::rasterLargeOfInstances, true};
    case Stage::cutOfInstances:
        return {"raster/cut blades of instances", shader::rasterCutOfInstances, true};
    }
    expect(false, "every stage has a shader");
    return {};
}

/// What the stages of all instances together depend on.
RasterPass::Variant ofInstances(const RasterPass::Variant& variant)
{
    return {.samples = variant.samples, .groupsDrawLarge = variant.groupsDrawLarge};
}

} // namespace

VkDeviceSize visibilityBytes(glm::uvec2 size, std::uint32_t samples)
{
    return VkDeviceSize(size.x) * shared::rowsOfColumn(size.y) * samples * sizeof(std::uint64_t);
}

RasterPass::RasterPass(const gpu::DeviceContext& context)
    : context_(&context)
    , frameLayout_(context, "raster/frame")
{
}

void RasterPass::make(const gpu::ShaderLibrary& shaders, Stage stage, const Variant& variant)
{
    const std::pair key{stage, variant};
    if (pipelines_.contains(key))
        return;
    const StageShader stageShader = shaderOf(stage);
    const std::uint32_t largeTo =
        variant.groupsDrawLarge ? shared::largeToGroups : shared::largeToNone;
    const std::uint32_t pushBytes =
        stageShader.isOfInstances ? sizeof(shared::HostViewPush) : sizeof(shared::RasterPush);
    std::vector<VkDescriptorSetLayout> sets;
    if (!stageShader.isOfInstances)
        sets.push_back(frameLayout_.get());
    pipelines_.emplace(
        key, gpu::ComputePipeline(
                 *context_, shaders,
                 {.name = stageShader.name,
                  .shader = stageShader.module,
                  .pushConstantBytes = pushBytes,
                  .setLayouts = std::move(sets),
                  .constants = {
                      {.id = shared::idSamplesPerPixel, .value = variant.samples},
                      {.id = shared::idFillsAll, .value = stage == Stage::allDepths},
                      {.id = shared::idIsPaged, .value = variant.isPaged},
                      {.id = shared::idLargeTo, .value = largeTo},
                      {.id = shared::idMayFold, .value = variant.looks.mayFold},
                      {.id = shared::idOnlyShape, .value = variant.looks.onlyShape},
                      {.id = shared::idMayHaveOrgans, .value = variant.looks.mayHaveOrgans}}}));
}

const gpu::ComputePipeline& RasterPass::made(Stage stage, const Variant& variant) const
{
    const auto found = pipelines_.find({stage, variant});
    expect(found != pipelines_.end(), "the raster pass has been prepared for the view");
    return found->second;
}

void RasterPass::prepare(const gpu::ShaderLibrary& shaders, std::span<const Variant> instances,
                         bool hasTwoPasses)
{
    expect(!instances.empty(), "a view that is rasterised has an instance");
    for (const Variant& instance : instances)
        make(shaders, Stage::blades, instance);
    const Variant& variant = instances.front();
    if (instances.size() > 1) {
        make(shaders, Stage::cutOfInstances, ofInstances(variant));
        if (variant.groupsDrawLarge)
            make(shaders, Stage::largeOfInstances, ofInstances(variant));
        return;
    }
    make(shaders, Stage::cut, variant);
    if (!variant.groupsDrawLarge)
        return;
    make(shaders, Stage::large, variant);
    if (!hasTwoPasses)
        return;
    make(shaders, Stage::depths, variant);
    make(shaders, Stage::lateBlades, variant);
    make(shaders, Stage::lateLarge, variant);
}

void RasterPass::prepareAllDepths(const gpu::ShaderLibrary& shaders, const Variant& variant)
{
    make(shaders, Stage::allDepths, variant);
}

void RasterPass::recordBlades(const gpu::Recording& commands, const View& view, std::uint32_t round,
                              Phase phase) const
{
    const gpu::ComputePipeline* bound = nullptr;
    for (const Instance& instance : view.instances) {
        if (instance.list == nullptr)
            continue;
        shared::RasterPush push = instance.push;
        push.round = phase == Phase::late ? instance.list->roundCount() + round : round;
        const gpu::ComputePipeline& pipeline =
            made(phase == Phase::late ? Stage::lateBlades : Stage::blades, instance.variant);
        if (&pipeline != std::exchange(bound, &pipeline))
            pipeline.bind(commands);
        instance.frame.bind(commands, pipeline.layout(), frameSet);
        pipeline.push(commands, push);
        commands.vk->CmdDispatchIndirect(commands, instance.list->rounds().get(),
                                         push.round * sizeof(shared::WalkLevel));
    }
}

void RasterPass::recordLarge(const gpu::Recording& commands, const View& view, Phase phase) const
{
    const auto bind = [&](Stage ofOne, Stage ofAll) {
        if (view.several != nullptr) {
            const gpu::ComputePipeline& pipeline = made(ofAll, ofInstances(view.variant));
            pipeline.bind(commands);
            pipeline.push(commands, *view.several);
            return;
        }
        const Instance& instance = view.instances.front();
        const gpu::ComputePipeline& pipeline = made(ofOne, view.variant);
        pipeline.bind(commands);
        instance.frame.bind(commands, pipeline.layout(), frameSet);
        pipeline.push(commands, instance.push);
    };
    if (view.variant.groupsDrawLarge && phase == Phase::late) {
        bind(Stage::lateLarge, Stage::lateLarge);
        view.large->dispatchLate(commands);
    } else if (view.variant.groupsDrawLarge) {
        bind(Stage::large, Stage::largeOfInstances);
        view.large->dispatch(commands);
    }
    bind(Stage::cut, Stage::cutOfInstances);
    view.large->dispatchCut(commands);
}

void RasterPass::recordDepths(const gpu::Recording& commands, const View& view, Levels levels) const
{
    const auto groups = [](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(
            gpu::groupsFor(shared::pyramidCells(pixels, 0), shared::pyramidThreads));
    };
    const gpu::ComputePipeline& pipeline =
        made(levels == Levels::all ? Stage::allDepths : Stage::depths, view.variant);
    pipeline.bind(commands);
    pipeline.push(commands, view.instances.front().push);
    commands.vk->CmdDispatch(commands, groups(view.size.x), groups(view.size.y), 1);
}

} // namespace sward::render
