// Blades of a field of which only a part is in memory: they come and go by pages.
#ifndef SWARD_SHARED_PAGES_H
#define SWARD_SHARED_PAGES_H

#include "shaders/shared/frame.h"
#include "shaders/shared/patch_tree.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Blades of a page: 16 KiB of the file. A patch has its blades on one page or on two.
SHARED_CONST uint pageBlades = 1024u;

/// Where a page is that is not in memory.
SHARED_CONST uint noPlace = 0xffffffffu;

// Bits of PageChange::edges: besides the patches that are on the page as a whole, …
SHARED_CONST uint lowEdge = 1u;  ///< … the one that began on the page before comes or goes with it
SHARED_CONST uint highEdge = 2u; ///< … and the one that ends on the page behind

/// A page that has come into memory, or leaves it.
struct PageChange {
    uint page;
    uint place; ///< of its first blade in memory from now on, or noPlace
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
    CountedSubtreeArray subtrees; ///< whose blades are those in memory
    FloatArray patchTimes;
    UintArray patchCounts;
    UintArray nonEmptyPatches;      ///< as in RasterPush
    UintArray firstNonEmptyPatches; ///< likewise
    uint nonEmptyPatchCount;
    uint bladeCount; ///< of the field
    float settledAt; ///< [s] since when a blade that comes has stood in its wind
    uint reserved;
};
SHARED_LAYOUT(PagePush, 96)

SHARED_END
#endif
