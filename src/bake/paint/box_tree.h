#pragma once

#include "core/bounds.h"

#include <cstddef>
#include <vector>

namespace sward::bake {

/// Boxes in a tree of eight children each, for the question whether any of them meets a box.
class BoxTree {
public:
    explicit BoxTree(std::vector<DAabb> boxes);

    bool isEmpty() const { return levels_.empty(); }
    bool meets(const DAabb& box) const;

private:
    bool meets(const DAabb& box, std::size_t level, std::size_t first, std::size_t last) const;

    std::vector<std::vector<DAabb>> levels_; ///< the boxes first, the widest last
};

} // namespace sward::bake
