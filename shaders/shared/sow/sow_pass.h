// Passes that grow units of a field with seeds on the device (decision 0045), and their buffers.
#ifndef SWARD_SHARED_SOW_SOW_PASS_H
#define SWARD_SHARED_SOW_SOW_PASS_H

#include "shaders/shared/sow/sown_blade.h"

SHARED_BEGIN

/// A clump of a cell, in a list of those whose places have the same hash.
struct SowCentre {
    ivec3 place; ///< units
    uint next;    ///< the next one of its list; noSeedBits: none
    uint64_t key;
    uint piece;   ///< as SeedClump::piece
    int moisture; ///< as SeedClump::moisture
};
SHARED_LAYOUT(SowCentre, 32)

/// A ribbon of a species, see sowRibbon().
struct SowRibbon {
    float height;  ///< in heights of the stalk
    float width;   ///< in lengths
    float longest; ///< as `height`, of any blade
};
SHARED_LAYOUT(SowRibbon, 12)

SHARED_BUFFER(SowMeadows, SowMeadow, readonly)
SHARED_BUFFER(SowRibbons, SowRibbon, readonly)
SHARED_BUFFER(SeedVertexArray, SeedVertex, readonly)
SHARED_BUFFER(SeedPieceArray, SeedPiece, readonly)
SHARED_BUFFER(SeedConditionArray, SeedConditions, readonly)
SHARED_BUFFER(SowCentreArray, SowCentre, readonly)
SHARED_BUFFER(SowListHeads, uint, readonly)

/// A 32 m cell in device memory.
struct SowCell {
    SeedVertexArray vertices;
    SeedPieceArray pieces;
    SeedConditionArray conditions;
    SowWords words;
    SowWaves waves;
    SowCentreArray centres;
    SowListHeads heads; ///< first of each list of `centres`; noSeedBits: none
    uint headMask;      ///< number of lists − 1, a power of two − 1
    uint centreCount;
    SowGround ground;
    float heightScale; ///< factor on SowMeadow::heightsPerMetre, see sowHeightScale()
    uint reserved;
};
SHARED_LAYOUT(SowCell, 88)
SHARED_BUFFER(SowCellArray, SowCell, readonly)

/// A unit to grow: ranks from `from` to below `share` in a cube of its cell.
struct SowOrder {
    SowCellArray cell; ///< one
    ivec3 low;         ///< of the cube [units from the cell's corner]
    uint sideBits;     ///< side of the cube: 2^sideBits units
    uint level;        ///< of its blades, see sowLevel()
    float from;
    float share;
    uint reserved;
};
SHARED_LAYOUT(SowOrder, 40)
SHARED_BUFFER(SowOrderArray, SowOrder, readonly)

/// A piece of a unit's cell of which candidates may stand in the unit.
struct SowRun {
    uint unit; ///< of the batch
    uint piece;
};
SHARED_LAYOUT(SowRun, 8)
SHARED_BUFFER(SowRunArray, SowRun, readonly)

/// A candidate that grows.
struct SowRecord {
    uint cell; ///< sowCells · unit + octree cell in it, in Morton order
    uint piece;
    uint candidate;
    float rank;
};
SHARED_LAYOUT(SowRecord, 16)
SHARED_BUFFER(SowRecordArray, SowRecord, )

/// Octree cells of a unit: 8³.
SHARED_CONST uint sowCells = 512u;

/// Stalks that an octree cell of a unit may have on the device; the CPU grows units with more.
SHARED_CONST uint maxStalksOfCell = 1024u;

/// Threads of a work-group of each pass.
SHARED_CONST uint sowFindThreads = 64u;
SHARED_CONST uint sowScanThreads = 256u;
SHARED_CONST uint sowSortThreads = 256u;
SHARED_CONST uint sowGrowThreads = 64u;
SHARED_CONST uint sowLayThreads = 128u;
SHARED_CONST uint sowPlaceThreads = 64u;

/// A stalk before its ribbons.
struct SowStalk {
    PackedBlade bits;
    float height; ///< [m] before quantisation
};
SHARED_LAYOUT(SowStalk, 20)
SHARED_BUFFER(SowStalkArray, SowStalk, )

/// A patch of blades that have been grown.
struct SowPatch {
    vec3 boundsLow;  ///< relative to the low corner of its 32 m cell [m]
    uint cell;       ///< as SowRecord::cell
    vec3 boundsHigh; ///< the same
    uint firstBlade; ///< of the batch
    vec3 coneAxis;
    float coneCosine;
    uint bladeCount;
    uint widest; ///< largest width, in steps of the patch
    float rankLow;
    float rankHigh;
};
SHARED_LAYOUT(SowPatch, 64)
SHARED_BUFFER(SowPatchArray, SowPatch, writeonly)

/// What a batch has, beside arguments of its indirect dispatches.
struct SowCounts {
    uint sortGroups[3]; ///< of sort_candidates.comp
    uint growGroups[3]; ///< of grow_stalks.comp
    uint layGroups[3];  ///< of lay_patches.comp; x: octree cells with candidates
    uint records;       ///< candidates that grow
    uint sorted;        ///< the same, as far as cells have got their part of the sorted list
    uint blades;
    uint patches;
};
SHARED_LAYOUT(SowCounts, 52)
SHARED_BUFFER(SowCountsArray, SowCounts, )
SHARED_BUFFER(SowWordArray, uint, )
SHARED_BUFFER(SowBladeArray, PackedBlade, )

/// A batch of units that are grown together.
struct SowBatch {
    SowMeadows meadow;
    SowTones tones;
    SowRibbons ribbons; ///< of species 0, then of species 1, and so on
    SowOrderArray units;
    SowRunArray runs;
    SowCountsArray counts;
    SowWordArray failed;   ///< one a unit, not 0 if it does not fit: the CPU grows it
    SowWordArray cells;    ///< candidates of each octree cell of each unit
    SowWordArray ends;     ///< first of these among the sorted records; then their end
    SowWordArray growing;  ///< octree cells with candidates
    SowRecordArray records;
    SowRecordArray sorted; ///< by octree cell
    SowStalkArray stalks;
    SowBladeArray blades;
    SowPatchArray patches;
    uint runCount;
    uint unitCount;
    uint maxRecords;
    uint maxBlades;
    uint maxPatches;
    uint reserved;
};
SHARED_LAYOUT(SowBatch, 144)
SHARED_BUFFER(SowBatchArray, SowBatch, readonly)

/// Push constant of the passes.
struct SowBatchPush {
    SowBatchArray batch;
};
SHARED_LAYOUT(SowBatchPush, 8)

/// Blades of a batch that get a place in the field's table.
struct SowMove {
    uint from;
    uint to;
    uint count;
};
SHARED_LAYOUT(SowMove, 12)
SHARED_BUFFER(SowMoveArray, SowMove, readonly)

struct SowPlacePush {
    SowMoveArray moves;
    BladeArray from;
    SowBladeArray to;
    uint moveCount;
    uint reserved;
};
SHARED_LAYOUT(SowPlacePush, 32)

SHARED_END
#endif
