#include "render/streaming/missing_search.h"

#include <algorithm>
#include <cstddef>

namespace sward::render {
namespace {

/// Entries that are allocated in advance; a search hardly needs more.
constexpr std::size_t usualMissing = 65536;

} // namespace

MissingSearch::MissingSearch(const PageTree& tree, const PageScores& scores)
    : tree_(tree)
    , scores_(scores)
{
    heap_.reserve(std::min<std::size_t>(usualMissing, 2 * std::size_t(tree.patchCount())));
}

bool MissingSearch::isWorse(const Entry& a, const Entry& b)
{
    return a.bound != b.bound ? a.bound < b.bound : a.node > b.node;
}

void MissingSearch::begin()
{
    heap_.clear();
    left_ = 0.0f;
    if (tree_.patchCount() == 0 || tree_.node(0).missing == PageTree::noRank)
        return;
    const PageScores::Sight sight = scores_.nearest(tree_.patch(0), tree_.node(0).widest, false);
    push(0, sight, tree_.node(0).missing, false);
}

void MissingSearch::push(std::uint32_t node, const PageScores::Sight& sight, float rank,
                         bool isBelow)
{
    heap_.push_back({PageScores::scoreOf(sight, rank), PageScores::drawnScoreOf(sight, rank), rank,
                     node, sight.isOutside, isBelow});
    std::ranges::push_heap(heap_, isWorse);
}

std::optional<MissingSearch::Found> MissingSearch::next(const Floor& floor, VisitBudget& visits)
{
    while (!heap_.empty()) {
        const Entry best = heap_.front();
        if (best.bound <= floor.patches) {
            end();
            break;
        }
        if (visits.isSpent())
            return std::nullopt;
        std::ranges::pop_heap(heap_, isWorse);
        heap_.pop_back();

        const shared::Patch& cell = tree_.patch(best.node);
        if (!best.isBelow && tree_.isMissing(best.node)) {
            visits.take(1);
            const PageScores::Sight sight =
                scores_.nearest(cell, tree_.node(best.node).widest, false);
            const float below = tree_.missingBelow(best.node);
            if (below != PageTree::noRank)
                push(best.node, sight, below, true);
            const Found found{best.node, PageScores::scoreOf(sight, cell.rankLow),
                              PageScores::drawnScoreOf(sight, cell.rankLow)};
            if (found.score > floor.patches)
                return found;
            leaveOut(found.drawn);
            continue;
        }
        // Blades that have come since leave it a lower bound.
        const float rank =
            best.isBelow ? tree_.missingBelow(best.node) : tree_.node(best.node).missing;
        if (rank == PageTree::noRank)
            continue;
        if (rank > best.rank) {
            visits.take(1);
            push(best.node, scores_.nearest(cell, tree_.node(best.node).widest, best.isOutside),
                 rank, best.isBelow);
            continue;
        }
        const float lowest =
            std::max(floor.margin * floor.patches, best.isOutside ? 0.0f : floor.inSight);
        if (best.bound <= lowest) {
            leaveOut(best.drawn);
            continue;
        }
        visits.take(cell.childCount);
        for (std::uint32_t c = 0; c < cell.childCount; ++c) {
            const std::uint32_t child = cell.firstChild + c;
            const PageTree::Node& node = tree_.node(child);
            if (node.missing == PageTree::noRank)
                continue;
            push(child, scores_.nearest(tree_.patch(child), node.widest, best.isOutside),
                 node.missing, false);
        }
    }
    return std::nullopt;
}

void MissingSearch::end()
{
    for (const Entry& entry : heap_)
        leaveOut(entry.drawn);
    heap_.clear();
}

void MissingSearch::leaveOut(float drawn)
{
    left_ = std::max(left_, drawn);
}

float MissingSearch::drawnMissing() const
{
    float most = left_;
    for (const Entry& entry : heap_)
        most = std::max(most, entry.drawn);
    return most;
}

} // namespace sward::render
