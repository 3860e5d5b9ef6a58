// Traversal of the patch tree: from its coarse nodes down to the culled nodes.
#ifndef SWARD_SHARED_PATCH_TREE_H
#define SWARD_SHARED_PATCH_TREE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// Data of a node and its subtree that the file does not contain; computed at load time.
struct Subtree {
    uint blades;     ///< of the node and of all nodes below
    float widest;    ///< [m] maximum full width at the root of these blades
    float rankBelow; ///< the lowest progressive rank below the node; 1 if there is no node
};
SHARED_LAYOUT(Subtree, 12)

SHARED_BUFFER(SubtreeArray, Subtree, readonly)

/// A visible patch: some of its blades may be visible.
struct VisiblePatch {
    uint patchIndex;
    uint count; ///< number of its first blades to process
};
SHARED_LAYOUT(VisiblePatch, 8)

SHARED_BUFFER(VisiblePatchArray, VisiblePatch, )

/// The nodes of a level to test: VkDispatchIndirectCommand and the number of nodes.
struct WalkLevel {
    uint groups[3];
    uint count;
};
SHARED_LAYOUT(WalkLevel, 16)

SHARED_BUFFER(WalkLevelArray, WalkLevel, )

/// Place of the walk's result among the walk's levels: the visible patches.
SHARED_CONST uint visibleLevel = 0u;

// Patches that a dispatch of the update takes. Code for colliders makes a CPU slow also where none
// is near.
SHARED_CONST uint takesAll = 0u;
SHARED_CONST uint takesFar = 1u;  ///< patches that no collider may touch; lists the others
SHARED_CONST uint takesNear = 2u; ///< these others

/// Threads of a work-group of the walk, one node each.
SHARED_CONST uint walkThreads = 64u;

/// The walk begins with all nodes of the first levels at once, up to this number of nodes: a few
/// more box tests instead of several dependent dispatches.
SHARED_CONST uint walkStart = 8192u;

/// The same on a GPU: on an H200 a step takes 9 µs with few nodes, and 11 µs with this number.
SHARED_CONST uint walkStartOfGpu = 131072u;

SHARED_END
#endif
