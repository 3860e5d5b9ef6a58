#include "render/streaming/page_budget.h"

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

/// Levels of a walk, counts, constants and species.
constexpr std::uint64_t smallBytes = std::uint64_t(64) << 10;

std::uint64_t MiB(std::uint64_t bytes)
{
    return (bytes + (std::uint64_t(1) << 20) - 1) >> 20;
}

} // namespace

std::uint64_t treeBytes(const field::FieldView& field, std::uint32_t instances, std::uint32_t views)
{
    constexpr std::uint64_t index = sizeof(std::uint32_t);
    const std::uint64_t perList = index + sizeof(shared::VisiblePatch);
    const std::uint64_t perInstance = sizeof(float) + index + views * perList;
    const std::uint64_t perPatch =
        sizeof(shared::Patch) + sizeof(shared::Subtree) + index + instances * perInstance;
    return field.patches.size() * perPatch +
           (field.blades.size() / shared::nonEmptyPatchStride + 1) * index + instances * smallBytes;
}

Streaming::Settings streamingOf(std::uint64_t pages, std::uint32_t framesInFlight,
                                bool waitsForDisk)
{
    // Limit a frame to an eighth of a small pool.
    const std::uint64_t pageBytes = pageBlades * sizeof(shared::PackedBlade);
    return {.framesInFlight = framesInFlight,
            .frameBytes =
                std::min(maxFrameBytes, std::max<std::uint64_t>(pages / 8, 1) * pageBytes),
            .waitsForDisk = waitsForDisk};
}

std::uint64_t pagingBytes(const field::FieldView& field, const Streaming::Settings& settings)
{
    return (field.blades.size() / pageBlades + 1) * sizeof(std::uint32_t) +
           Streaming::bytesFor(settings);
}

std::uint32_t pagesWithin(const field::FieldView& field, const PageBudget& budget)
{
    if (budget.whole <= budget.bytes)
        return 0;

    // Bisect the largest number of pages that fits.
    std::uint64_t fit = 0;
    std::uint64_t tooMany = field.blades.size() / pageBlades + 1;
    while (tooMany - fit > 1) {
        const std::uint64_t pages = (fit + tooMany) / 2;
        (budget.with(pages) <= budget.bytes ? fit : tooMany) = pages;
    }
    const std::uint64_t least =
        std::max<std::uint64_t>(std::min(minPages, field.blades.size() / pageBlades), 1);
    if (fit < least)
        fail(ErrorKind::runtime,
             "a budget of {} MiB of device memory is too small for the field's {} blades in {} "
             "patches: at least {} MiB are needed to show some of them, {} MiB for all",
             budget.bytes >> 20, field.blades.size(), field.patches.size(),
             std::min(MiB(budget.with(least)), MiB(budget.whole)), MiB(budget.whole));
    return static_cast<std::uint32_t>(fit);
}

} // namespace sward::render
