#pragma once

#include "field/field.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sward::field {

/// Searches for nearest roots in the patch tree, whose boxes contain all roots below them.
class RootSearch {
public:
    /// The field must outlive the search.
    explicit RootSearch(const FieldView& field)
        : field_(field)
    {
    }

    /// Distance [m] from the root of blade `index` to the nearest other root; nothing if there is
    /// none at a finite distance.
    std::optional<double> nearest(std::size_t index);

    /// Patches visited so far.
    std::uint64_t visited() const { return visited_; }

private:
    void visit(const shared::Patch& patch, std::size_t self, const glm::dvec3& from, double& best);

    const FieldView& field_;
    std::uint64_t visited_ = 0;
    std::vector<std::pair<double, std::uint32_t>> waiting_; // squared distance, patch
};

} // namespace sward::field
