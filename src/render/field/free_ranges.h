#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sward::render {

/// Consecutive places of a table.
struct PlaceRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t end() const { return first + count; } ///< one past the last
    bool operator==(const PlaceRange&) const = default; ///< same places
};

/// The same places in rising order, none twice.
std::vector<PlaceRange> united(std::vector<PlaceRange> ranges);

/// The free places of a table. The smallest range that suffices is taken; neighbours are merged.
class FreeRanges {
public:
    /// Takes `count` > 0 consecutive places; none if no free range is that long.
    std::optional<PlaceRange> take(std::uint32_t count);

    /// Frees places, which must not be free. An empty range is ignored.
    void give(PlaceRange range);

    /// One past the last place in use, of a table of `size` places.
    std::uint32_t usedEnd(std::uint32_t size) const;

    /// Length of the free range at the end of a table of `size` places.
    std::uint32_t tail(std::uint32_t size) const { return size - usedEnd(size); }

private:
    std::map<std::uint32_t, std::uint32_t> byPlace_;           ///< first place: count
    std::set<std::pair<std::uint32_t, std::uint32_t>> bySize_; ///< count, first place
};

} // namespace sward::render
