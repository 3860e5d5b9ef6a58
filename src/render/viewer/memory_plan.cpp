#include "render/viewer/memory_plan.h"

#include "render/streaming/page_budget.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

#include <algorithm>

namespace sward::render {
namespace {

/// The list of visible blades, and the counts of its rounds.
std::uint64_t roundBytes(const PatchSizes& sizes, const field::FieldView& field,
                         const FieldBuffers::Records& records, std::uint64_t places, bool isPaged)
{
    if (records.list)
        return 0;
    const std::uint64_t patches = FieldBuffers::roundPatchesOf(sizes, records, places, isPaged);
    return std::min(sizes.maxBladesOf(patches), places) * sizeof(shared::VisibleBlade) +
           2 * (field.patches.size() / patches + 1) * sizeof(shared::WalkLevel);
}

} // namespace

std::uint64_t wholeBytes(const field::FieldView& field, const FieldBuffers::Records& records)
{
    const std::uint64_t places = field.blades.size();
    return treeBytes(field) + places * records.bytesPerBlade(true) +
           roundBytes(PatchSizes(field.patches), field, records, places, false);
}

MemoryPlan planFor(const field::FieldView& field, const FieldBuffers::Records& wanted,
                   const MemoryBudget& budget)
{
    const PatchSizes sizes(field.patches);
    const auto streamed = [&](std::uint64_t pages) {
        return streamingOf(pages, budget.framesInFlight, budget.waitsForDisk);
    };
    const auto bytesWith = [&](std::uint64_t pages) {
        const std::uint64_t places = pages * shared::pageBlades;
        return budget.others + treeBytes(field) + places * wanted.bytesPerBlade(true) +
               roundBytes(sizes, field, wanted, places, true) + pagingBytes(field, streamed(pages));
    };
    MemoryPlan plan{.records = wanted, .streaming = {}};
    plan.records.pages =
        pagesWithin(field, {budget.bytes, budget.others + wholeBytes(field, wanted), bytesWith});
    if (plan.records.pages > 0)
        plan.streaming = streamed(plan.records.pages);
    return plan;
}

} // namespace sward::render
