// How often the blades of a patch are moved.
#ifndef SWARD_SHARED_UPDATE_RATE_H
#define SWARD_SHARED_UPDATE_RATE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

struct UpdateRate {
    float everyFrame; ///< [m] patches nearer than this move in every frame …
    float everyThird; ///< [m] … those nearer than this in every third, in turn …
    float longest;    ///< [s] … and all others when they have stood still for so long
    uint frame;       ///< running number of the frame
};
SHARED_LAYOUT(UpdateRate, 16)

/// A blade that was thinned out when its patch last moved comes back as if it had stood in its wind
/// for so long [s] as it is now.
SHARED_CONST float settlingTime = 12.0f;

/// Whether the blades of patch `index` move in this frame, `distance` [m] from the eye and last
/// moved `elapsed` [s] ago. What they missed they catch up: see advanceBlade().
SHARED_FN bool movesNow(UpdateRate updateRate, uint index, float distance, float elapsed)
{
    if (distance < updateRate.everyFrame || elapsed >= updateRate.longest)
        return true;
    return distance < updateRate.everyThird && (updateRate.frame + index) % 3u == 0u;
}

SHARED_END
#endif
