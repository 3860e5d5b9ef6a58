// The visibility history decides which parts of a blade are drawn in the early pass and which in the late one. The
// including stage has a push constant `push` of type UpdatePush and the feature flags `features` and `testsSmall`.
#ifndef SWARD_CULL_VISIBILITY_HISTORY_GLSL
#define SWARD_CULL_VISIBILITY_HISTORY_GLSL

#include "shaders/shared/passes.h"

/// Whether a blade that covers `pixels` pixels is tested for occlusion by other blades.
bool isTested(float pixels)
{
    return pixels > (testsSmall ? testedSmallPixels : testedPixels);
}

/// Whether blades are drawn in an early and a late pass, by the visibility history.
bool hasTwoPasses()
{
    return uvec2(push.history) != uvec2(0u);
}

/// Quarters of a blade in the visibility history: the early pass draws them. Returns all quarters of a blade that the
/// late pass does not test.
uint takeHistory(uint index, bool isTestedLater)
{
    if (!isTestedLater)
        return allQuarters;
    UintArray words = push.history;
    const uint shift = quarters * (index % bladesOfHistoryWord);
    const uint seen = (words.at[index / bladesOfHistoryWord] >> shift) & allQuarters;
    if (seen != 0u && forgetsHistory(index, push.frame))
        atomicAnd(words.at[index / bladesOfHistoryWord], ~(allQuarters << shift));
    return seen;
}

#endif
