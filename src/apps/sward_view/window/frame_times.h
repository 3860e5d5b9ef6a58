#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace sward::view {

/// Times and numbers of the window's frames.
struct FrameTimes {
    using Clock = std::chrono::steady_clock;

    Clock::time_point begun = Clock::now();
    Clock::time_point lastTick = begun, lastTitle = begun, lastLook = begun, lastNotice = begun;
    std::optional<Clock::time_point> firstShown;
    double frameBefore = 0.0;                    ///< [s] field time of the previous frame
    double frameSeconds = 0.0;                   ///< real time since the previous frame
    std::uint64_t frames = 0, framesAtTitle = 0; ///< moving pictures of this field
};

} // namespace sward::view
