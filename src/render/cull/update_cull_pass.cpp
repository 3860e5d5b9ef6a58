#include "render/cull/update_cull_pass.h"

#include "core/expect.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

#include <algorithm>

namespace sward::render {
namespace {

// The shader packs survivors as 3 bits for the patch and 9 bits for the blade in it.
static_assert(shared::patchesTogether <= 8 && shared::maxPatchBlades <= 512);

/// Threads of a work-group. On a CPU every SIMD lane executes the work of the active ones, so a
/// work-group has as many threads as lanes. With colliders each blade has a thread: llvmpipe ends
/// all loops of an invocation after 65 535 iterations, and a blade may take thousands.
std::uint32_t threadsOf(const gpu::DeviceContext& context, bool hasColliders)
{
    constexpr std::uint32_t lanesOfCpu = 8;
    static_assert(lanesOfCpu >= shared::cullResultCount && lanesOfCpu >= shared::colliderWords);
    if (!context.isCpu())
        return shared::updateThreads;
    return hasColliders
               ? std::min(shared::maxPatchBlades, context.limits.maxComputeWorkGroupInvocations)
               : lanesOfCpu;
}

UpdateCullPass::Variant withoutColliders(UpdateCullPass::Variant variant)
{
    variant.hasColliders = false;
    return variant;
}

/// Place of the count of patches near colliders among the walk's levels.
VkDeviceSize nearOffset(const VisibleBlades& found)
{
    return VkDeviceSize(found.nearLevel()) * sizeof(shared::WalkLevel);
}

} // namespace

// One on a CPU: llvmpipe ends all loops of an invocation after 65 535 iterations, and a patch among
// colliders takes thousands.
std::uint32_t UpdateCullPass::patchesOfGroup(const gpu::DeviceContext& context)
{
    return context.isCpu() ? 1 : shared::patchesTogether;
}

UpdateCullPass::UpdateCullPass(const gpu::DeviceContext& context)
    : context_(&context)
    , frameLayout_(context, "update/frame")
{
}

bool UpdateCullPass::splits(Variant variant) const
{
    return variant.hasColliders && context_->isCpu();
}

void UpdateCullPass::prepare(const gpu::ShaderLibrary& shaders, Variant variant)
{
    if (!splits(variant)) {
        prepareOne(shaders, {variant, shared::takesAll});
        return;
    }
    prepareOne(shaders, {withoutColliders(variant), shared::takesFar});
    prepareOne(shaders, {variant, shared::takesNear});
}

void UpdateCullPass::prepareOne(const gpu::ShaderLibrary& shaders, Pipeline wanted)
{
    if (pipelines_.contains(wanted))
        return;
    const Variant& variant = wanted.variant;
    pipelines_.emplace(
        wanted, gpu::ComputePipeline(
                    *context_, shaders,
                    {.name = "update and cull",
                     .shader = shader::updateCull,
                     .pushConstantBytes = sizeof(shared::UpdatePush),
                     .setLayouts = {frameLayout_.get()},
                     .constants = {
                         {.id = shared::idWindCounts, .value = variant.windCounts},
                         {.id = shared::idHasColliders, .value = variant.hasColliders},
                         {.id = shared::idThreadsOfGroup,
                          .value = threadsOf(*context_, variant.hasColliders)},
                         {.id = shared::idRole, .value = static_cast<std::uint32_t>(variant.role)},
                         {.id = shared::idKeepsBefore, .value = variant.keepsBefore},
                         {.id = shared::idKeepsEtas, .value = variant.keepsEtas},
                         {.id = shared::idTestsSmall, .value = variant.testsSmall},
                         {.id = shared::idFeatures, .value = variant.features},
                         {.id = shared::idPatchesOfGroup, .value = patchesOfGroup(*context_)},
                         {.id = shared::idTakes, .value = wanted.takes}}}));
}

void UpdateCullPass::bind(const gpu::Recording& commands, Pipeline wanted,
                          const BakedBlades& blades, const VisibleBlades& found, Scope scope,
                          const Input& input) const
{
    const auto made = pipelines_.find(wanted);
    expect(made != pipelines_.end(), "the update has been prepared for the frame's wind");
    const gpu::ComputePipeline& pipeline = made->second;
    pipeline.bind(commands);
    input.frame.bind(commands, pipeline.layout(), 0);
    const VkDeviceAddress levels = found.levels().address();
    pipeline.push(commands, shared::UpdatePush{.cullView = input.frame.address,
                                               .visiblePatches = found.visiblePatches(),
                                               .levels = levels,
                                               .nearCount = levels + nearOffset(found),
                                               .near = found.queue(),
                                               .rounds = found.rounds().address(),
                                               .nonEmptyPatches = blades.nonEmptyPatches(),
                                               .views = input.views,
                                               .before = input.before,
                                               .history = input.history.address,
                                               .nonEmptyPatchCount = blades.entryCount(),
                                               .onlyUpdate = scope == Scope::all ? 1u : 0u,
                                               .firstPatch = input.round * found.roundPatches(),
                                               .maxPatches = found.roundPatches(),
                                               .round = input.round,
                                               .lateRound = found.roundCount() + input.round,
                                               .viewCount = input.viewCount,
                                               .frame = input.history.frame});
}

void UpdateCullPass::record(const gpu::Recording& commands, const BakedBlades& blades,
                            const VisibleBlades& found, Variant variant, Scope scope,
                            const Input& input) const
{
    if (blades.nonEmptyPatchCount() == 0)
        return;
    const bool isSplit = splits(variant);
    if (isSplit) {
        gpu::memoryBarrier(commands, gpu::dispatchAccess, gpu::transferAccess);
        commands.vk->CmdFillBuffer(commands, found.levels().get(), nearOffset(found),
                                   sizeof(shared::WalkLevel), 0);
        gpu::transferToCompute(commands);
    }
    bind(commands,
         isSplit ? Pipeline{withoutColliders(variant), shared::takesFar}
                 : Pipeline{variant, shared::takesAll},
         blades, found, scope, input);
    if (scope == Scope::all) {
        const std::uint32_t groups =
            shared::updateGroups(blades.entryCount(), patchesOfGroup(*context_));
        commands.vk->CmdDispatch(commands, std::min(groups, input.maxGroups), 1, 1);
    } else {
        commands.vk->CmdDispatchIndirect(commands, found.levels().get(),
                                         shared::visibleLevel * sizeof(shared::WalkLevel));
    }
    if (!isSplit)
        return;
    gpu::computeToCompute(commands);
    bind(commands, {variant, shared::takesNear}, blades, found, scope, input);
    commands.vk->CmdDispatchIndirect(commands, found.levels().get(), nearOffset(found));
}

} // namespace sward::render
