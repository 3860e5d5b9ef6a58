#include "render/memory_plan.h"

#include "core/error.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

#include <algorithm>

namespace sward::render {
namespace {

using shared::pageBlades;

/// Minimum number of pages that can show a field: some are being loaded, some seen, some leaving.
constexpr std::uint64_t minPages = 16;

/// Maximum upload per frame [bytes]: copies in about half a millisecond; at 60 frames/s, 240 MiB/s.
constexpr std::uint64_t maxFrameBytes = std::uint64_t(4) << 20;

/// Levels of the walk, counts, and species.
constexpr std::uint64_t smallBytes = std::uint64_t(64) << 10;

/// Patches, subtrees, times of their last moves, and the lists of the walk.
std::uint64_t treeBytes(const field::FieldView& field)
{
    constexpr std::uint64_t perPatch = sizeof(shared::Patch) + sizeof(shared::Subtree) +
                                       sizeof(float) + sizeof(std::uint32_t) +
                                       2 * sizeof(std::uint32_t) + sizeof(shared::VisiblePatch);
    return field.patches.size() * perPatch +
           (field.blades.size() / shared::nonEmptyPatchStride + 1) * sizeof(std::uint32_t) +
           smallBytes;
}

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

std::uint64_t MiB(std::uint64_t bytes)
{
    return (bytes + (std::uint64_t(1) << 20) - 1) >> 20;
}

Streaming::Settings streamingOf(std::uint64_t pages, const MemoryBudget& budget)
{
    // Limit a frame to an eighth of a small pool.
    const std::uint64_t pageBytes = pageBlades * sizeof(shared::PackedBlade);
    return {.framesInFlight = budget.framesInFlight,
            .frameBytes =
                std::min(maxFrameBytes, std::max<std::uint64_t>(pages / 8, 1) * pageBytes),
            .waitsForDisk = budget.waitsForDisk};
}

/// Bytes of a field's buffers with `pages` pages of its blades.
std::uint64_t pagedBytes(const PatchSizes& sizes, const field::FieldView& field,
                         const FieldBuffers::Records& records, const MemoryBudget& budget,
                         std::uint64_t pages)
{
    const std::uint64_t places = pages * pageBlades;
    const std::uint64_t table = (field.blades.size() / pageBlades + 1) * sizeof(std::uint32_t);
    return treeBytes(field) + table + places * records.bytesPerBlade(true) +
           roundBytes(sizes, field, records, places, true) +
           Streaming::bytesFor(streamingOf(pages, budget));
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
    MemoryPlan plan{.records = wanted, .streaming = {}};
    const std::uint64_t whole = budget.others + wholeBytes(field, wanted);
    if (whole <= budget.bytes)
        return plan;

    // Bisect the largest number of pages that fits.
    const PatchSizes sizes(field.patches);
    std::uint64_t fit = 0;
    std::uint64_t tooMany = field.blades.size() / pageBlades + 1;
    while (tooMany - fit > 1) {
        const std::uint64_t pages = (fit + tooMany) / 2;
        const bool fits =
            budget.others + pagedBytes(sizes, field, wanted, budget, pages) <= budget.bytes;
        (fits ? fit : tooMany) = pages;
    }
    const std::uint64_t least = std::min(minPages, field.blades.size() / pageBlades);
    if (fit < std::max<std::uint64_t>(least, 1))
        fail(ErrorKind::runtime,
             "a budget of {} MiB of device memory is too small for the field's {} blades in {} "
             "patches: at least {} MiB are needed to show some of them, {} MiB for all",
             budget.bytes >> 20, field.blades.size(), field.patches.size(),
             std::min(MiB(budget.others + pagedBytes(sizes, field, wanted, budget,
                                                     std::max<std::uint64_t>(least, 1))),
                      MiB(whole)),
             MiB(whole));
    plan.records.pages = static_cast<std::uint32_t>(fit);
    plan.streaming = streamingOf(fit, budget);
    return plan;
}

} // namespace sward::render
