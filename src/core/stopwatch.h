#pragma once

#include <chrono>
#include <ctime>

namespace sward {

/// Seconds of processor time, user and system, that all threads of the process have taken.
inline double processorSeconds()
{
    return double(std::clock()) / double(CLOCKS_PER_SEC);
}

/// Measures durations.
class Stopwatch {
public:
    /// Seconds since construction or the last call.
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace sward
