// The part of Frame::debugMode that is known at pipeline creation.
#ifndef SWARD_SHARED_DEBUG_MODE_H
#define SWARD_SHARED_DEBUG_MODE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// The normal picture.
SHARED_CONST uint debugNothing = 0u;

/// Ground and blades show the wind's speed.
SHARED_CONST uint debugWind = 3u;

/// No debug mode: the pipeline reads the frame's mode, which is not debugWind.
SHARED_CONST uint debugAsTold = 0xffffffffu;

SHARED_END
#endif
