#include "render/field/free_ranges.h"

#include "core/expect.h"

#include <iterator>

namespace sward::render {

std::vector<PlaceRange> united(std::vector<PlaceRange> ranges)
{
    std::ranges::sort(ranges, {}, &PlaceRange::first);
    std::vector<PlaceRange> result;
    for (const PlaceRange& range : ranges) {
        if (result.empty() || result.back().end() < range.first)
            result.push_back(range);
        else
            result.back().count = std::max(result.back().end(), range.end()) - result.back().first;
    }
    return result;
}

std::optional<PlaceRange> FreeRanges::take(std::uint32_t count)
{
    expect(count > 0, "a range has places");
    const auto found = bySize_.lower_bound({count, 0});
    if (found == bySize_.end())
        return std::nullopt;
    const auto [size, first] = *found;
    bySize_.erase(found);
    byPlace_.erase(first);
    if (size > count) {
        byPlace_.emplace(first + count, size - count);
        bySize_.emplace(size - count, first + count);
    }
    return PlaceRange{first, count};
}

void FreeRanges::give(PlaceRange range)
{
    if (range.count == 0)
        return;
    const auto after = byPlace_.lower_bound(range.first);
    expect(after == byPlace_.end() || after->first >= range.end(), "the places are in use");
    if (after != byPlace_.begin()) {
        const auto before = std::prev(after);
        expect(before->first + before->second <= range.first, "the places are in use");
        if (before->first + before->second == range.first) {
            range = {before->first, before->second + range.count};
            bySize_.erase({before->second, before->first});
            byPlace_.erase(before);
        }
    }
    if (after != byPlace_.end() && after->first == range.end()) {
        range.count += after->second;
        bySize_.erase({after->second, after->first});
        byPlace_.erase(after);
    }
    byPlace_.emplace(range.first, range.count);
    bySize_.emplace(range.count, range.first);
}

std::uint32_t FreeRanges::usedEnd(std::uint32_t size) const
{
    if (byPlace_.empty())
        return size;
    const auto last = std::prev(byPlace_.end());
    return last->first + last->second == size ? last->first : size;
}

} // namespace sward::render
