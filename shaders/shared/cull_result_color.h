// The colour of a blade's cull result, in the picture and in the viewer's legend.
#ifndef SWARD_SHARED_CULL_RESULT_COLOR_H
#define SWARD_SHARED_CULL_RESULT_COLOR_H

#include "shaders/shared/culling.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Frame::debugMode that draws every blade in the colour of its cull result.
SHARED_CONST uint debugReason = 4u;

/// Linear, and easy to distinguish for most eyes (after Okabe & Ito).
SHARED_FN vec3 cullResultColor(uint cullResult)
{
    if (cullResult == cullResultDrawn)
        return vec3(0.06f, 0.34f, 0.12f);
    if (cullResult == cullResultPatch)
        return vec3(0.30f, 0.30f, 0.33f);
    if (cullResult == cullResultOrientation)
        return vec3(0.86f, 0.77f, 0.05f);
    if (cullResult == cullResultFrustum)
        return vec3(0.66f, 0.11f, 0.01f);
    if (cullResult == cullResultDistance)
        return vec3(0.02f, 0.17f, 0.45f);
    if (cullResult == cullResultOcclusion)
        return vec3(0.60f, 0.19f, 0.38f);
    return vec3(0.09f, 0.46f, 0.81f);
}

SHARED_END
#endif
