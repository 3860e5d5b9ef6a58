#include "render/viewer/memory_plan.h"

#include "core/error.h"
#include "render/streaming/page_budget.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <limits>

namespace sward::render {
namespace {

/// Blades of which one list holds all.
constexpr std::uint64_t wholeLists = std::uint64_t(1) << 24;

/// The list of visible blades, and the counts of its rounds.
std::uint64_t roundBytes(const PatchSizes& sizes, const field::FieldView& field,
                         const BladeRecords& records, std::uint64_t places, bool isPaged)
{
    if (records.list)
        return 0;
    const std::uint64_t patches = roundPatchesOf(sizes, records, places, isPaged);
    return std::min(sizes.maxBladesOf(patches), places) * sizeof(shared::VisibleBlade) +
           2 * (field.patches.size() / patches + 1) * sizeof(shared::WalkLevel);
}

} // namespace

VkDeviceSize BladeRecords::bytesPerBlade(bool withEtas) const
{
    return sizeof(shared::PackedBlade) + sizeof(shared::BladeState::turn) +
           (withEtas ? sizeof(shared::BladeState::eta) : 0) +
           (list ? sizeof(shared::VisibleBlade) : 0) + (cullResults ? sizeof(std::uint32_t) : 0);
}

std::uint32_t roundPatchesOf(const PatchSizes& sizes, const BladeRecords& records,
                             std::uint64_t places, bool isPaged)
{
    if (records.roundPatches > 0)
        return records.roundPatches;
    constexpr std::uint64_t minPatches = 64;
    const std::uint64_t least =
        isPaged ? minPatches * shared::maxPatchBlades : std::min(places, wholeLists);
    return std::max(sizes.patchesWithin(std::max(places / 8, least)), 1u);
}

std::uint32_t roundPatchesOf(const BakedBlades& blades, const BladeRecords& records)
{
    constexpr std::uint32_t all = std::numeric_limits<std::uint32_t>::max();
    const bool holdsEdits =
        blades.isEditable() && records.roundPatches == 0 && blades.placeCount() <= wholeLists;
    if (records.list || holdsEdits)
        return all;
    return roundPatchesOf(blades.patchSizes(), records, blades.placeCount(), blades.isPaged());
}

std::uint64_t wholeBytes(const field::FieldView& field, const BladeRecords& records)
{
    const std::uint64_t places = field.blades.size();
    return treeBytes(field) + places * records.bytesPerBlade(true) +
           roundBytes(PatchSizes(field.patches), field, records, places, false);
}

MemoryPlan planFor(const field::FieldView& field, const BladeRecords& records,
                   const MemoryBudget& budget)
{
    const PatchSizes sizes(field.patches);
    const auto streamed = [&](std::uint64_t pages) {
        return streamingOf(pages, budget.framesInFlight, budget.waitsForDisk);
    };
    const auto bytesWith = [&](std::uint64_t pages) {
        const std::uint64_t places = pages * shared::pageBlades;
        return budget.others + treeBytes(field) + places * records.bytesPerBlade(true) +
               roundBytes(sizes, field, records, places, true) +
               pagingBytes(field, streamed(pages));
    };
    MemoryPlan plan;
    plan.pages =
        pagesWithin(field, {budget.bytes, budget.others + wholeBytes(field, records), bytesWith});
    if (plan.pages > 0)
        plan.streaming = streamed(plan.pages);
    return plan;
}

void requireMemory(const gpu::DeviceContext& context, const field::FieldView& field,
                   const BladeRecords& records, const MemoryPlan& plan)
{
    const VkDeviceSize blades =
        plan.pages > 0 ? VkDeviceSize(plan.pages) * shared::pageBlades : field.blades.size();
    const VkDeviceSize needed = blades * records.bytesPerBlade(plan.pages > 0) +
                                field.patches.size() * sizeof(shared::Patch);
    if (needed > context.deviceLocalBytes())
        fail(ErrorKind::runtime,
             "the field's {} blades need {} MiB of device memory; {} has {} MiB (with a budget, "
             "--gpu-memory, it is shown in part)",
             field.blades.size(), needed >> 20, context.name, context.deviceLocalBytes() >> 20);
}

} // namespace sward::render
