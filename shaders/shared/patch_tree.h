// How the patch tree is walked: from its coarse nodes down, no deeper than something is seen.
#ifndef SWARD_SHARED_PATCH_TREE_H
#define SWARD_SHARED_PATCH_TREE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// What stands below a node and on it, as the file does not say it; found when a field is loaded.
struct Subtree {
    uint blades;     ///< of the node and of all nodes below
    float widest;    ///< [m] full width at the root that none of them exceeds
    float rankBelow; ///< the lowest progressive rank below the node; 1 if there is no node
};
SHARED_LAYOUT(Subtree, 12)

SHARED_BUFFER(SubtreeArray, Subtree, readonly)

/// A patch of which blades may be seen.
struct VisiblePatch {
    uint patchIndex;
    uint count; ///< its first so many
};
SHARED_LAYOUT(VisiblePatch, 8)

SHARED_BUFFER(VisiblePatchArray, VisiblePatch, )

/// How many nodes of a level are to be looked at: VkDispatchIndirectCommand and the number itself.
struct WalkLevel {
    uint groups[3];
    uint count;
};
SHARED_LAYOUT(WalkLevel, 16)

SHARED_BUFFER(WalkLevelArray, WalkLevel, )

/// Place among the walk's levels of what the walk brings home: the visible patches.
SHARED_CONST uint liveLevel = 0u;

/// Threads of a work-group of the walk, one node each.
SHARED_CONST uint walkThreads = 64u;

/// The walk begins with all nodes of the first levels at once, as many levels as have no more nodes
/// than this: a few more tests of boxes instead of some dispatches that wait for each other.
SHARED_CONST uint walkStart = 8192u;

/// The same on a GPU: on an H200 a step takes 9 µs however few nodes it has, and so many of
/// them 11.
SHARED_CONST uint walkStartOfGpu = 131072u;

SHARED_END
#endif
