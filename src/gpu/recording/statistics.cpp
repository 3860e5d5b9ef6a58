#include "gpu/recording/statistics.h"

#include <algorithm>
#include <vector>

namespace sward::gpu {

Statistics statisticsOf(std::span<const double> values)
{
    if (values.empty())
        return {};
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);

    const std::size_t count = sorted.size();
    const double median =
        count % 2 == 1 ? sorted[count / 2] : 0.5 * (sorted[count / 2 - 1] + sorted[count / 2]);
    // Nearest rank: the ⌈0.99 · count⌉-th value.
    const std::size_t rank = (99 * count + 99) / 100;
    return {.min = sorted.front(), .median = median, .p99 = sorted[rank - 1], .count = count};
}

} // namespace sward::gpu
