#pragma once

#include <cstdint>

namespace sward::render {

/// Visits of nodes in a frame: what bounds its work, whatever the field's size.
struct VisitBudget {
    static constexpr std::uint32_t perPage = 16; ///< granted for each page that comes

    /// Granted once in a frame if no page is known that may leave: after a cut.
    static constexpr std::uint32_t forRanking = 2048;

    std::uint32_t granted = 0;
    std::uint32_t used = 0; ///< may exceed what is granted by the children of a node

    bool isSpent() const { return used >= granted; }
    void take(std::uint32_t nodes) { used += nodes; }
};

} // namespace sward::render
