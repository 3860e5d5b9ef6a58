#pragma once

#include <cstddef>
#include <span>

namespace sward::gpu {

/// Summary of a series of measurements; all zero for an empty series.
struct Statistics {
    double min = 0.0;
    double median = 0.0; ///< for an even count the mean of the middle two
    double p99 = 0.0;    ///< the smallest value that 99 % of all do not exceed (nearest rank)
    std::size_t count = 0;
};

Statistics statisticsOf(std::span<const double> values);

} // namespace sward::gpu
