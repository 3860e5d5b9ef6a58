#pragma once

#include "field/field.h"
#include "render/streaming/streaming.h"

#include <cstdint>
#include <functional>

namespace sward::render {

/// Bytes of a field's patch tree, which is always resident, with the times of its last moves for
/// each of `instances` and the lists of its walk for each of their `views`; an upper bound.
std::uint64_t treeBytes(const field::FieldView& field, std::uint32_t instances = 1,
                        std::uint32_t views = 1);

/// Settings for `pages` pages of blades. Streaming::Settings says what the other two are.
Streaming::Settings streamingOf(std::uint64_t pages, std::uint32_t framesInFlight,
                                bool waitsForDisk);

/// Bytes of the table of pages and of what streams them.
std::uint64_t pagingBytes(const field::FieldView& field, const Streaming::Settings& settings);

/// How much a budget holds.
struct PageBudget {
    std::uint64_t bytes = 0; ///< in total
    std::uint64_t whole = 0; ///< needed if all blades are resident

    /// Bytes that a number of pages of blades needs; rises with it.
    std::function<std::uint64_t(std::uint64_t)> with;
};

/// The largest number of pages of a field's blades that fits into the budget; 0: all blades do.
/// Throws Error{runtime} that names the budget and the minimum if the budget is too small.
std::uint32_t pagesWithin(const field::FieldView& field, const PageBudget& budget);

} // namespace sward::render
