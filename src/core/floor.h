#pragma once

#include <cstdint>

namespace sward {

/// The largest integer that is not above `x`, which must be within ±2⁶². Without SSE4.1, which not
/// every x86-64 has, std::floor is a call.
inline std::int64_t floorOf(double x)
{
    const auto towardsZero = static_cast<std::int64_t>(x);
    return towardsZero - std::int64_t(x < double(towardsZero));
}

} // namespace sward
