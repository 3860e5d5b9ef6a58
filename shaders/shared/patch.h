// A node of the patch tree, as stored in the field file and in GPU memory.
#ifndef SWARD_SHARED_PATCH_H
#define SWARD_SHARED_PATCH_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_CONST uint maxPatchBlades = 512u;
SHARED_CONST uint noPatch = 0xffffffffu;

/// One cell of the world octree that holds blades. A cell of at most 32 m contains up to 512 of the
/// blades inside it, in progressive order; the remaining blades belong to its children. A wider
/// cell contains none. All lengths are relative to the field's origin, in metres.
struct Patch {
    vec3 boundsLow;  ///< bounds of the whole subtree, with the reach of every bent blade
    uint firstBlade; ///< its own blades: firstBlade … firstBlade + bladeCount − 1
    vec3 boundsHigh;
    uint bladeCount;  ///< ≤ maxPatchBlades
    vec3 rootLow;     ///< root = rootLow + rootStep · (16-bit numbers)
    float rootStep;   ///< [m]
    vec3 coneAxis;    ///< the up-vectors of the subtree lie within a cone about this unit axis …
    float coneCosine; ///< … with this cosine of its half angle
    float heightLow;  ///< height = heightLow + heightStep · (8-bit number) [m]
    float heightStep;
    float widthLow; ///< width = widthLow + widthStep · (6-bit number) [m]
    float widthStep;
    uint parent;     ///< index of the parent, noPatch at the root
    uint firstChild; ///< its children are consecutive in the array; noPatch if it has none
    uint childCount; ///< ≤ 8
    uint level;      ///< depth below the root of the tree
    float rankLow;   ///< share of the surrounding blades before this patch's own, coarse to fine
    float rankHigh;  ///< the same for its last one; blade i of n has the rank low + (high − low)·(i
                     ///< + ½)/n
};
SHARED_LAYOUT(Patch, 104)

SHARED_BUFFER(PatchArray, Patch, readonly)

SHARED_END
#endif
