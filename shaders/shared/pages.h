// Paging: only a part of a field's blades is in memory; pages of blades are loaded and evicted.
#ifndef SWARD_SHARED_PAGES_H
#define SWARD_SHARED_PAGES_H

#include "shaders/shared/frame.h"
#include "shaders/shared/patch_tree.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Blades of a page: 16 KiB of the file. The blades of a patch lie on one page or two.
SHARED_CONST uint pageBlades = 1024u;

/// Place of a page that is not in memory.
SHARED_CONST uint noPlace = 0xffffffffu;

// Bits of PageChange::edges: besides the patches completely on the page, …
SHARED_CONST uint lowEdge = 1u;  ///< … the one that begins on the page before is added or removed
SHARED_CONST uint highEdge = 2u; ///< … the one that ends on the page after is added or removed

/// A page that has entered memory, or leaves it.
struct PageChange {
    uint page;
    uint place; ///< new place of its first blade in memory, or noPlace
    uint edges;
};
SHARED_LAYOUT(PageChange, 12)

SHARED_BUFFER(PageChangeArray, PageChange, readonly)
SHARED_BUFFER(CountedSubtreeArray, Subtree, )

/// Threads of a work-group for one changed page.
SHARED_CONST uint pageThreads = 64u;

struct PagePush {
    PageChangeArray changes; ///< one work-group each
    UintArray pages;         ///< Frame::pages
    UintArray states;        ///< Frame::states
    FloatArray etas;         ///< Frame::etas
    PatchArray patches;
    CountedSubtreeArray subtrees; ///< counting only blades in memory
    UintArray patchTimes;
    UintArray patchCounts;
    UintArray nonEmptyPatches;      ///< as in RasterPush
    UintArray firstNonEmptyPatches; ///< likewise
    uint nonEmptyPatchCount;
    uint bladeCount; ///< of the field
    uint settledAt; ///< tick of the last update of a new blade, which counts as settled in its wind
    uint isOfStates; ///< 0: changes the table and the counts; else the states of one placed field
};
SHARED_LAYOUT(PagePush, 96)

SHARED_END
#endif
