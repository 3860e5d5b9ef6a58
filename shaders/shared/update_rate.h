// Update rate of the blades of a patch.
#ifndef SWARD_SHARED_UPDATE_RATE_H
#define SWARD_SHARED_UPDATE_RATE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

struct UpdateRate {
    float everyFrame; ///< [m] nearer patches move in every frame …
    float everyThird; ///< [m] … those nearer than this in every third, in turn …
    float longest;    ///< [s] … and all others after this time without motion
    uint frame;       ///< running number of the frame
};
SHARED_LAYOUT(UpdateRate, 16)

/// Times of updates are counted in ticks, modulo 2³²: 4.55 hours. An integer has no coarser steps
/// late than early. A patch that is seen again after exactly that time moves on as if it had just
/// been seen.
SHARED_CONST float ticksPerSecond = 262144.0f;

/// [s] from tick `then` to tick `now`.
SHARED_FN float secondsBetween(uint then, uint now)
{
    return float(now - then) / ticksPerSecond;
}

/// A blade that was thinned out at its patch's last update reappears as if it had been in its
/// current wind for this time [s].
SHARED_CONST float settlingTime = 12.0f;

/// Whether the blades of patch `index`, `distance` [m] from the eye and last moved `elapsed` [s]
/// ago, move in this frame. advanceBlade() catches up on the elapsed time.
SHARED_FN bool movesNow(UpdateRate updateRate, uint index, float distance, float elapsed)
{
    if (distance < updateRate.everyFrame || elapsed >= updateRate.longest)
        return true;
    return distance < updateRate.everyThird && (updateRate.frame + index) % 3u == 0u;
}

SHARED_END
#endif
