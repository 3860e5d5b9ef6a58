#pragma once

#include "render/streaming/page_scores.h"
#include "render/streaming/page_tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::render {

/// Counts the pages of which a frame's views draw, for statistics.
class PageCensus {
public:
    explicit PageCensus(const PageTree& tree);

    /// Visits two thousand nodes more. A census keeps its views from begin to end, which takes
    /// several calls for a large field; the call after its end begins the next one.
    void advance(const PageScores& scores);

    std::uint32_t wanted() const { return wanted_; }   ///< pages with blades that a view draws
    std::uint32_t missing() const { return missing_; } ///< of these, not resident

private:
    void visit(std::uint32_t patch);

    const PageTree& tree_;
    PageScores scores_;
    std::vector<std::uint32_t> queue_;   ///< nodes
    std::vector<std::uint32_t> counted_; ///< by page: the census that has counted it
    std::size_t visited_ = 0;
    std::uint32_t number_ = 0; ///< of the census
    std::uint32_t wantedSoFar_ = 0;
    std::uint32_t missingSoFar_ = 0;
    std::uint32_t wanted_ = 0;
    std::uint32_t missing_ = 0;
};

/// Distance [m] from the eye of a frame's view to the nearest patch in sight that it draws of
/// without thinning, and that is not resident; infinity if there is none.
float nearestMissing(const PageTree& tree, const PageScores& scores);

} // namespace sward::render
