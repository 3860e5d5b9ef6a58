#pragma once

#include <cstddef>
#include <span>

namespace sward::gpu {

/// What is left of a series of measurements; all zero for an empty one.
struct Statistics {
    double min = 0.0;
    double median = 0.0; ///< for an even number the mean of the middle two
    double p99 = 0.0;    ///< the smallest value that is not exceeded by 99 % of all (nearest rank)
    std::size_t count = 0;
};

Statistics statisticsOf(std::span<const double> values);

} // namespace sward::gpu
