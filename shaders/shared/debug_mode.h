// What of Frame::debugMode a pipeline may know when it is made.
#ifndef SWARD_SHARED_DEBUG_MODE_H
#define SWARD_SHARED_DEBUG_MODE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// The picture as it is.
SHARED_CONST uint debugNothing = 0u;

/// Ground and blades show the wind's speed.
SHARED_CONST uint debugWind = 3u;

/// No debug mode: the pipeline knows of none but that it is not debugWind, and asks the frame.
SHARED_CONST uint debugAsTold = 0xffffffffu;

SHARED_END
#endif
