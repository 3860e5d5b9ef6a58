#include "render/frame/frame_time.h"

#include "core/error.h"
#include "shaders/shared/update_rate.h"

#include <cmath>

namespace sward::render {

void requireValidTime(double time)
{
    // Of NaN no comparison holds.
    requireUsage(std::abs(time) <= longestTime, "the time of a frame is {} s, beyond ±{:.0f} s",
                 time, longestTime);
}

std::uint32_t tickOf(double time)
{
    return static_cast<std::uint32_t>(std::llround(time * double(shared::ticksPerSecond)));
}

std::uint32_t settledTick(double time)
{
    return tickOf(time - double(shared::settlingTime));
}

bool movesOn(double before, double time)
{
    return time >= before && time - before <= longestTimeStep;
}

} // namespace sward::render
