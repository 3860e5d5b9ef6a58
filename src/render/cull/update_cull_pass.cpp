#include "render/cull/update_cull_pass.h"

#include "core/expect.h"
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

void UpdateCullPass::prepare(const gpu::ShaderLibrary& shaders, Variant variant)
{
    if (pipelines_.contains(variant))
        return;
    pipelines_.emplace(
        variant, gpu::ComputePipeline(
                     *context_, shaders,
                     {.name = "update and cull",
                      .shader = "update_cull.comp",
                      .pushConstantBytes = sizeof(shared::UpdatePush),
                      .setLayouts = {frameLayout_.get()},
                      .constants = {{.id = 0, .value = variant.windCounts},
                                    {.id = 1, .value = variant.hasColliders},
                                    {.id = 2, .value = threadsOf(*context_, variant.hasColliders)},
                                    {.id = 3, .value = static_cast<std::uint32_t>(variant.role)},
                                    {.id = 4, .value = variant.keepsBefore},
                                    {.id = 5, .value = variant.keepsEtas},
                                    {.id = 6, .value = variant.testsSmall},
                                    {.id = 7, .value = variant.features},
                                    {.id = 8, .value = patchesOfGroup(*context_)}}}));
}

void UpdateCullPass::record(const gpu::Recording& commands, const BakedBlades& blades,
                            const VisibleBlades& found, Variant variant, Scope scope,
                            const Input& input) const
{
    if (blades.nonEmptyPatchCount() == 0)
        return;
    const auto made = pipelines_.find(variant);
    expect(made != pipelines_.end(), "the update has been prepared for the frame's wind");
    const gpu::ComputePipeline& pipeline = made->second;
    pipeline.bind(commands);
    input.frame.bind(commands, pipeline.layout(), 0);
    pipeline.push(commands, shared::UpdatePush{.cullView = input.frame.address,
                                               .live = found.live(),
                                               .levels = found.levels().address(),
                                               .rounds = found.rounds().address(),
                                               .nonEmptyPatches = blades.nonEmptyPatches(),
                                               .views = input.views,
                                               .before = input.before,
                                               .seenBefore = input.shown.quarters,
                                               .nonEmptyPatchCount = blades.nonEmptyPatchCount(),
                                               .onlyUpdate = scope == Scope::all ? 1u : 0u,
                                               .firstLive = input.round * found.roundPatches(),
                                               .maxLive = found.roundPatches(),
                                               .round = input.round,
                                               .lateRound = found.roundCount() + input.round,
                                               .viewCount = input.viewCount,
                                               .frame = input.shown.frame});
    if (scope == Scope::all) {
        const std::uint32_t groups =
            shared::updateGroups(blades.nonEmptyPatchCount(), patchesOfGroup(*context_));
        commands.vk->CmdDispatch(commands, std::min(groups, input.maxGroups), 1, 1);
    } else {
        commands.vk->CmdDispatchIndirect(commands, found.levels().get(),
                                         shared::liveLevel * sizeof(shared::WalkLevel));
    }
}

} // namespace sward::render
