// What has been seen of a blade lately decides in which turn it is drawn. The including stage has a push
// constant `push` of type UpdatePush, and says by `asks` and `asksSmall` what frames ask for.
#ifndef SWARD_SEEN_QUARTERS_GLSL
#define SWARD_SEEN_QUARTERS_GLSL

#include "shaders/shared/passes.h"

/// Whether it is asked for a blade of so many pixels if others hide it.
bool isAsked(float pixels)
{
    return pixels > (asksSmall ? askedSmallPixels : askedPixels);
}

/// Whether blades are drawn in the early and the late pass, by the visibility history.
bool takesTurns()
{
    return uvec2(push.seenBefore) != uvec2(0u);
}

/// Which quarters of a blade have been seen lately, by the visibility history. A blade that is not asked later
/// counts as seen.
uint takeSeen(uint index, bool isAskedLater)
{
    if (!isAskedLater)
        return allQuarters;
    UintArray words = push.seenBefore;
    const uint shift = quarters * (index % seenOfWord);
    const uint seen = (words.at[index / seenOfWord] >> shift) & allQuarters;
    if (seen != 0u && forgetsSeen(index, push.frame))
        atomicAnd(words.at[index / seenOfWord], ~(allQuarters << shift));
    return seen;
}

#endif
