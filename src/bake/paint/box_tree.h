#pragma once

#include "core/bounds.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sward::bake {

/// Boxes in a tree of eight children each, for the question whether any of them meets a box.
class BoxTree {
public:
    explicit BoxTree(std::vector<DAabb> boxes);

    bool isEmpty() const { return levels_.empty(); }
    bool meets(const DAabb& box) const;

    /// Calls visit(index) for each of the given boxes that meets `box`, in no order.
    template <typename Visit>
    void visit(const DAabb& box, const Visit& visit) const
    {
        if (!isEmpty())
            visitBelow(box, levels_.size() - 1, 0, levels_.back().size(), visit);
    }

    /// Whether two boxes share a point.
    static bool doMeet(const DAabb& a, const DAabb& b)
    {
        return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
               b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
    }

private:
    static constexpr std::size_t children = 8;

    template <typename Visit>
    void visitBelow(const DAabb& box, std::size_t level, std::size_t first, std::size_t last,
                    const Visit& visit) const
    {
        for (std::size_t i = first; i < last; ++i) {
            if (!doMeet(box, levels_[level][i]))
                continue;
            if (level == 0)
                visit(order_[i]);
            else
                visitBelow(box, level - 1, i * children,
                           std::min((i + 1) * children, levels_[level - 1].size()), visit);
        }
    }

    bool meets(const DAabb& box, std::size_t level, std::size_t first, std::size_t last) const;

    std::vector<std::vector<DAabb>> levels_; ///< the boxes first, the widest last
    std::vector<std::size_t> order_;         ///< number of each box of the first level
};

} // namespace sward::bake
