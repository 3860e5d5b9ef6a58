#include "render/streaming/page_census.h"

#include "shaders/shared/visibility.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace sward::render {
namespace {

/// Nodes visited in one call: a fifth of a millisecond.
constexpr std::uint32_t visitsPerCall = 2048;

/// Drawn is what scores more.
constexpr float drawnScore = 1.0f;

float distanceOf(const PageScores& scores, const shared::Patch& cell)
{
    float distance = std::numeric_limits<float>::infinity();
    for (const shared::Eyepoint& view : scores.views())
        distance =
            std::min(distance, shared::boxDistance(view.eye, cell.boundsLow, cell.boundsHigh));
    return distance;
}

} // namespace

PageCensus::PageCensus(const PageTree& tree)
    : tree_(tree)
{
}

void PageCensus::advance(const PageScores& scores)
{
    if (tree_.patchCount() == 0)
        return;
    if (visited_ == queue_.size()) {
        scores_ = scores;
        counted_.resize(tree_.pageCount());
        queue_.assign(1, 0);
        visited_ = 0;
        ++number_;
        wantedSoFar_ = 0;
        missingSoFar_ = 0;
    }
    for (std::uint32_t i = 0; i < visitsPerCall && visited_ < queue_.size(); ++i)
        visit(queue_[visited_++]);
    if (visited_ < queue_.size())
        return;
    wanted_ = wantedSoFar_;
    missing_ = missingSoFar_;
}

void PageCensus::visit(std::uint32_t patch)
{
    const shared::Patch& cell = tree_.patch(patch);
    const PageScores::Sight sight = scores_.nearest(cell, tree_.node(patch).widest, false);
    if (sight.drawn <= 0.0f)
        return;
    if (cell.bladeCount > 0) {
        if (PageScores::drawnScoreOf(sight, cell.rankLow) <= drawnScore)
            return; // ranks rise downwards
        for (std::uint32_t page = PageTree::firstPage(cell); page <= PageTree::lastPage(cell);
             ++page)
            if (std::exchange(counted_[page], number_) != number_) {
                ++wantedSoFar_;
                missingSoFar_ += tree_.state(page) != PageTree::State::there ? 1u : 0u;
            }
    }
    for (std::uint32_t child = 0; child < cell.childCount; ++child)
        queue_.push_back(cell.firstChild + child);
}

float nearestMissing(const PageTree& tree, const PageScores& scores)
{
    using Entry = std::pair<float, std::uint32_t>; // distance, node
    std::vector<Entry> heap;
    const auto push = [&](std::uint32_t patch) {
        const PageTree::Node& node = tree.node(patch);
        if (node.missing == PageTree::noRank)
            return;
        const shared::Patch& cell = tree.patch(patch);
        const PageScores::Sight sight = scores.nearest(cell, node.widest, false);
        if (PageScores::drawnScoreOf(sight, node.missing) <= drawnScore)
            return;
        heap.emplace_back(distanceOf(scores, cell), patch);
        std::ranges::push_heap(heap, std::greater<>());
    };
    if (tree.patchCount() > 0)
        push(0);
    for (std::uint32_t visits = 0; !heap.empty(); ++visits) {
        const auto [distance, patch] = heap.front();
        std::ranges::pop_heap(heap, std::greater<>());
        heap.pop_back();
        const shared::Patch& cell = tree.patch(patch);
        const PageScores::Sight sight = scores.nearest(cell, tree.node(patch).widest, false);
        const bool isDrawn = PageScores::drawnScoreOf(sight, cell.rankLow) > drawnScore;
        // What remains is farther.
        if ((tree.isMissing(patch) && isDrawn) || visits == visitsPerCall)
            return distance;
        for (std::uint32_t child = 0; child < cell.childCount; ++child)
            push(cell.firstChild + child);
    }
    return std::numeric_limits<float>::infinity();
}

} // namespace sward::render
