#pragma once

#include "render/streaming/page_scores.h"
#include "render/streaming/page_tree.h"
#include "render/streaming/visit_budget.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::render {

/// Finds resident pages, about the lowest score first, by lower bounds.
class ResidentSearch {
public:
    /// A page of a higher score than another may be found before it, by this factor: so the search
    /// does not go down everywhere.
    static constexpr float slack = 1.19f;

    ResidentSearch(const PageTree& tree, const PageScores& scores);

    struct Found {
        std::uint32_t page = 0;
        float score = 0.0f;
        float drawn = 0.0f; ///< score in this frame's views
    };

    /// Begins anew from the root. `isExact`: false takes the pages of a node for equally far if
    /// they nearly are, and finds the lowest ones within a factor of two.
    void begin(bool isExact);
    void look() { ++frame_; } ///< the scores are those of another frame
    std::optional<Found> next(VisitBudget& visits);
    bool isDone() const { return heap_.empty() && pages_.empty(); } ///< nothing is left

    /// A page with the highest scores of the patches with blades on it.
    Found scored(std::uint32_t page, VisitBudget& visits) const;

private:
    struct Entry {
        float bound; ///< of the scores of pages with blades at or below the node
        std::uint32_t node;
        bool isPatch;            ///< stands for the node's own blades
        bool isSame;             ///< what lies below is taken for equally far, …
        PageScores::Sight sight; ///< … and seen like this
        bool operator<(const Entry& other) const
        {
            // Of equal ones those far down, which are closest to a page.
            return bound != other.bound ? bound > other.bound : node < other.node;
        }
    };
    struct Ranked {
        Found found;
        std::uint32_t frame = 0; ///< in which it was scored
        bool operator<(const Ranked& other) const
        {
            return found.score != other.found.score ? found.score > other.found.score
                                                    : found.page < other.found.page;
        }
    };
    void push(const Entry& entry);
    void push(const Found& found);
    void rankPages(const shared::Patch& cell, VisitBudget& visits);
    void expand(const Entry& entry, VisitBudget& visits);

    const PageTree& tree_;
    const PageScores& scores_;
    std::vector<Entry> heap_;           ///< the lowest bound first
    std::vector<Ranked> pages_;         ///< likewise
    std::vector<std::uint16_t> ranked_; ///< by page: the search that has put it into pages_
    std::uint16_t number_ = 0;          ///< of the search
    std::uint32_t frame_ = 0;
    bool isExact_ = false;
};

} // namespace sward::render
