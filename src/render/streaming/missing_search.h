#pragma once

#include "render/streaming/page_scores.h"
#include "render/streaming/page_tree.h"
#include "render/streaming/visit_budget.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::render {

/// Finds patches with missing blades, the highest score first: a best-first search down the patch
/// tree, led by upper bounds of the scores below a node. It continues where a frame has left off.
class MissingSearch {
public:
    MissingSearch(const PageTree& tree, const PageScores& scores);

    /// Scores up to which a search stops.
    struct Floor {
        float patches = PageScores::lowest; ///< patches of lower scores are not found
        float margin = 1.0f;  ///< a node is searched if its bound is so many times higher …
        float inSight = 0.0f; ///< … and above this if an eye sees it
    };

    /// A patch of which a page is absent.
    struct Found {
        std::uint32_t patch = 0;
        float score = 0.0f;
        float drawn = 0.0f; ///< score in this frame's views
    };

    void begin(); ///< anew from the root
    std::optional<Found> next(const Floor& floor, VisitBudget& visits);

    /// Whether the tree has been searched down to the floor; false while visits were lacking.
    bool isDone() const { return heap_.empty(); }

    /// Ends the search: what remains is not worth more than what is resident.
    void end();

    /// Notes blades that stay missing, with their Found::drawn.
    void leaveOut(float drawn);

    /// Upper bound of Found::drawn of all that was not found, or was left out.
    float drawnMissing() const;

private:
    struct Entry {
        float bound;        ///< of the scores at and below the node
        float drawn;        ///< likewise in this frame's views
        float rank;         ///< Node::missing, from which it was found
        std::uint32_t node; ///< of the tree
        bool isOutside;     ///< of all eyes
        bool isBelow;       ///< stands for the nodes below alone
    };
    static bool isWorse(const Entry& a, const Entry& b);

    void push(std::uint32_t node, const PageScores::Sight& sight, float rank, bool isBelow);

    const PageTree& tree_;
    const PageScores& scores_;
    std::vector<Entry> heap_;
    float left_ = 0.0f; ///< highest Found::drawn that was left out
};

} // namespace sward::render
