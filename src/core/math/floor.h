#pragma once

#include <cstdint>

namespace sward {

/// The largest integer not above `x`; |x| ≤ 2⁶². Replaces std::floor, which is a function call
/// without SSE4.1; baseline x86-64 lacks SSE4.1.
inline std::int64_t floorOf(double x)
{
    const auto towardsZero = static_cast<std::int64_t>(x);
    return towardsZero - std::int64_t(x < double(towardsZero));
}

} // namespace sward
