#include "render/streaming/page_tree.h"

#include "core/expect.h"

#include <algorithm>
#include <cstddef>

namespace sward::render {
namespace {

using shared::noPlace;
using shared::pageBlades;

/// The lower of two ranks, either of which may be PageTree::noRank.
float lower(float a, float b)
{
    if (a == PageTree::noRank)
        return b;
    return b == PageTree::noRank ? a : std::min(a, b);
}

} // namespace

PageTree::PageTree(const field::FieldView& field)
    : field_(field)
    , nodes_(field.patches.size())
    , pages_((field.blades.size() + pageBlades - 1) / pageBlades)
{
    for (std::uint32_t p = 0; p < patchCount(); ++p) {
        const shared::Patch& cell = field.patches[p];
        nodes_[p] = {noRank, noRank, 0.0f};
        if (cell.bladeCount == 0)
            continue;
        nodes_[p].missing = cell.rankLow;
        nodes_[p].widest = cell.widthLow + 63.0f * cell.widthStep;
        const std::uint32_t first = firstPage(cell);
        const std::uint32_t last = lastPage(cell);
        for (std::uint32_t page = first; page <= last; ++page)
            pages_[page].firstPatch = std::min(pages_[page].firstPatch, p);
        ++pages_[first].begun;
        if (first == last)
            continue;
        const std::uint32_t inFirst = pageBlades - cell.firstBlade % pageBlades;
        pages_[first].high = static_cast<std::uint16_t>(inFirst);
        pages_[last].low = static_cast<std::uint16_t>(cell.bladeCount - inFirst);
    }
    // Children come after their parents.
    for (std::uint32_t p = patchCount(); p-- > 1;) {
        Node& parent = nodes_[field.patches[p].parent];
        parent.missing = lower(parent.missing, nodes_[p].missing);
        parent.widest = std::max(parent.widest, nodes_[p].widest);
    }
}

float PageTree::missingBelow(std::uint32_t patch) const
{
    const shared::Patch& cell = field_.patches[patch];
    float least = noRank;
    for (std::uint32_t child = 0; child < cell.childCount; ++child)
        least = lower(least, nodes_[cell.firstChild + child].missing);
    return least;
}

std::uint32_t PageTree::firstPage(const shared::Patch& cell)
{
    return cell.firstBlade / pageBlades;
}

std::uint32_t PageTree::lastPage(const shared::Patch& cell)
{
    return (cell.firstBlade + cell.bladeCount - 1) / pageBlades;
}

bool PageTree::isMissing(std::uint32_t patch) const
{
    const shared::Patch& cell = field_.patches[patch];
    if (cell.bladeCount == 0)
        return false;
    const auto isOnItsWay = [this](std::uint32_t page) {
        return pages_[page].state == State::there || pages_[page].state == State::coming;
    };
    return !isOnItsWay(firstPage(cell)) || !isOnItsWay(lastPage(cell));
}

bool PageTree::isResident(std::uint32_t patch) const
{
    const shared::Patch& cell = field_.patches[patch];
    return cell.bladeCount > 0 && (isThere(firstPage(cell)) || isThere(lastPage(cell)));
}

bool PageTree::isThere(std::uint32_t page) const
{
    return page < pages_.size() && pages_[page].state == State::there;
}

std::uint32_t PageTree::placeOf(std::uint32_t page) const
{
    return isThere(page) ? pages_[page].place : noPlace;
}

void PageTree::take(std::uint32_t page, std::uint32_t place)
{
    expect(pages_[page].state == State::absent, "the page is not there");
    pages_[page].place = place;
    pages_[page].state = State::coming;
    forPatchesOf(page, [this](std::uint32_t patch) { findMissing(patch); });
}

shared::PageChange PageTree::arrive(std::uint32_t page)
{
    expect(pages_[page].state == State::coming, "the page is on its way");
    pages_[page].state = State::there;
    ++residentPages_;
    forPatchesOf(page, [this](std::uint32_t patch) { addResident(patch); });
    return change(page, true);
}

shared::PageChange PageTree::leave(std::uint32_t page)
{
    expect(pages_[page].state == State::there, "the page is there");
    pages_[page].state = State::leaving;
    --residentPages_;
    forPatchesOf(page, [this](std::uint32_t patch) {
        addMissing(patch);
        findResident(patch);
    });
    return change(page, false);
}

void PageTree::free(std::uint32_t page)
{
    expect(pages_[page].state == State::leaving, "the page has left");
    pages_[page].state = State::absent;
    pages_[page].place = noPlace;
}

shared::PageChange PageTree::change(std::uint32_t index, bool comes)
{
    // A patch on two pages is present only while both are.
    const Page& page = pages_[index];
    const bool low = page.low > 0 && isThere(index - 1);
    const bool high = page.high > 0 && isThere(index + 1);
    const std::size_t own =
        std::min<std::size_t>(pageBlades, field_.blades.size() - std::size_t(index) * pageBlades);
    std::uint64_t blades = own - page.low - page.high;
    if (low)
        blades += std::uint32_t(page.low) + pages_[index - 1].high;
    if (high)
        blades += std::uint32_t(page.high) + pages_[index + 1].low;
    blades_ += comes ? blades : std::uint64_t(0) - blades;
    patches_ += comes ? page.begun : std::uint64_t(0) - page.begun;
    return {.page = index,
            .place = comes ? page.place * pageBlades : noPlace,
            .edges = (low ? shared::lowEdge : 0u) | (high ? shared::highEdge : 0u)};
}

/// Renews Node::missing after a patch may have become complete, up to the first node that stays.
void PageTree::findMissing(std::uint32_t patch)
{
    for (;;) {
        const shared::Patch& cell = field_.patches[patch];
        float least = missingBelow(patch);
        if (isMissing(patch))
            least = lower(least, cell.rankLow);
        const float before = nodes_[patch].missing;
        if (least == before)
            return;
        nodes_[patch].missing = least;
        // A parent with a lower rank has it from elsewhere.
        if (cell.parent == shared::noPatch || nodes_[cell.parent].missing < before)
            return;
        patch = cell.parent;
    }
}

/// The same after a patch has become incomplete.
void PageTree::addMissing(std::uint32_t patch)
{
    const float rank = field_.patches[patch].rankLow;
    for (; patch != shared::noPatch; patch = field_.patches[patch].parent) {
        const float least = lower(nodes_[patch].missing, rank);
        if (least == nodes_[patch].missing)
            return;
        nodes_[patch].missing = least;
    }
}

/// Renews Node::resident after a patch may have lost its last resident page.
void PageTree::findResident(std::uint32_t patch)
{
    for (;;) {
        const shared::Patch& cell = field_.patches[patch];
        float highest = isResident(patch) ? cell.rankLow : noRank;
        for (std::uint32_t child = 0; child < cell.childCount; ++child)
            highest = std::max(highest, nodes_[cell.firstChild + child].resident);
        const float before = nodes_[patch].resident;
        if (highest == before)
            return;
        nodes_[patch].resident = highest;
        if (cell.parent == shared::noPatch || nodes_[cell.parent].resident > before)
            return;
        patch = cell.parent;
    }
}

/// The same after a patch has got a resident page.
void PageTree::addResident(std::uint32_t patch)
{
    const float rank = field_.patches[patch].rankLow;
    for (; patch != shared::noPatch; patch = field_.patches[patch].parent) {
        if (nodes_[patch].resident >= rank)
            return;
        nodes_[patch].resident = rank;
    }
}

} // namespace sward::render
