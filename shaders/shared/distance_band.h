// Distance bands, in which the area that grass covers is counted.
#ifndef SWARD_SHARED_DISTANCE_BAND_H
#define SWARD_SHARED_DISTANCE_BAND_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_CONST uint distanceBands = 8u;

/// Frame::debugMode of the first of three pictures of grass coverage by distance: red, green and
/// blue stand for bands 0 to 2, in the next mode for 3 to 5, in the last for 6 and 7.
SHARED_CONST uint debugNear = 5u;

/// The band of a point `distance` [m] away if grass is drawn up to `farthest` [m]. Band ends grow
/// by a constant factor, from 2 m or a hundredth of `farthest`. Nearer points belong to the first
/// band, farther points to the last.
SHARED_FN uint distanceBand(float distance, float farthest)
{
    const float nearest = min(2.0f, 0.01f * farthest);
    const float share = log2(max(distance, nearest) / nearest) / log2(farthest / nearest);
    return min(uint(float(distanceBands) * share), distanceBands - 1u);
}

SHARED_END
#endif
