#include "render/streaming/resident_search.h"

#include <algorithm>
#include <cstddef>

namespace sward::render {
namespace {

/// Entries that are allocated in advance; a search hardly needs more.
constexpr std::size_t usualResidents = 65536;

} // namespace

ResidentSearch::ResidentSearch(const PageTree& tree, const PageScores& scores)
    : tree_(tree)
    , scores_(scores)
    , ranked_(tree.pageCount())
{
    heap_.reserve(std::min<std::size_t>(usualResidents, 2 * std::size_t(tree.patchCount())));
    pages_.reserve(std::min<std::size_t>(usualResidents, tree.pageCount()));
}

void ResidentSearch::push(const Entry& entry)
{
    heap_.push_back(entry);
    std::push_heap(heap_.begin(), heap_.end());
}

void ResidentSearch::push(const Found& found)
{
    pages_.push_back({found, frame_});
    std::push_heap(pages_.begin(), pages_.end());
}

void ResidentSearch::begin(bool isExact)
{
    isExact_ = isExact;
    heap_.clear();
    pages_.clear();
    if (++number_ == 0) {
        std::ranges::fill(ranked_, std::uint16_t(0));
        number_ = 1;
    }
    if (tree_.patchCount() > 0 && tree_.node(0).resident != PageTree::noRank)
        push(Entry{0.0f, 0, false, false, {}});
}

ResidentSearch::Found ResidentSearch::scored(std::uint32_t page, VisitBudget& visits) const
{
    Found found{page, 0.0f, 0.0f};
    tree_.forPatchesOf(page, [&](std::uint32_t patch) {
        visits.take(1);
        const shared::Patch& cell = tree_.patch(patch);
        const PageScores::Sight sight = scores_.nearest(cell, tree_.node(patch).widest, false);
        found.score = std::max(found.score, PageScores::scoreOf(sight, cell.rankLow));
        found.drawn = std::max(found.drawn, PageScores::drawnScoreOf(sight, cell.rankLow));
    });
    return found;
}

void ResidentSearch::rankPages(const shared::Patch& cell, VisitBudget& visits)
{
    for (std::uint32_t page = PageTree::firstPage(cell); page <= PageTree::lastPage(cell); ++page)
        if (tree_.state(page) == PageTree::State::there && ranked_[page] != number_) {
            ranked_[page] = number_;
            push(scored(page, visits));
        }
}

void ResidentSearch::expand(const Entry& entry, VisitBudget& visits)
{
    visits.take(1);
    const shared::Patch& cell = tree_.patch(entry.node);
    if (tree_.isResident(entry.node)) {
        PageScores::Sight sight = entry.sight;
        if (!entry.isSame) {
            visits.take(1);
            sight = scores_.nearest(cell, tree_.node(entry.node).widest, false);
        }
        push(Entry{PageScores::scoreOf(sight, cell.rankLow), entry.node, true, false, {}});
    }
    for (std::uint32_t c = 0; c < cell.childCount; ++c) {
        Entry child = entry;
        child.node = cell.firstChild + c;
        const float rank = tree_.node(child.node).resident;
        if (rank == PageTree::noRank)
            continue;
        const shared::Patch& below = tree_.patch(child.node);
        if (!entry.isSame) {
            visits.take(1);
            child.isSame = !isExact_ && scores_.isAboutAsFar(below);
            child.sight = scores_.farthest(below, child.isSame);
        }
        child.bound = PageScores::scoreOf(child.sight, rank);
        child.isPatch = below.childCount == 0;
        push(child);
    }
}

std::optional<ResidentSearch::Found> ResidentSearch::next(VisitBudget& visits)
{
    while (!isDone() && !visits.isSpent()) {
        // A page whose score is close to the bound of all others needs no further search.
        if (!pages_.empty() &&
            (heap_.empty() || pages_.front().found.score <= slack * heap_.front().bound)) {
            std::pop_heap(pages_.begin(), pages_.end());
            const Ranked worst = pages_.back();
            pages_.pop_back();
            if (tree_.state(worst.found.page) != PageTree::State::there)
                continue;
            if (worst.frame == frame_)
                return worst.found;
            // The eyes may have moved since it was ranked.
            const Found found = scored(worst.found.page, visits);
            if (found.score <= slack * worst.found.score)
                return found;
            push(found);
            continue;
        }
        std::pop_heap(heap_.begin(), heap_.end());
        const Entry worst = heap_.back();
        heap_.pop_back();
        if (worst.isPatch)
            rankPages(tree_.patch(worst.node), visits);
        else
            expand(worst, visits);
    }
    return std::nullopt;
}

} // namespace sward::render
